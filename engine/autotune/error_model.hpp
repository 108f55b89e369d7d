#pragma once

#include "autotune/estimate.hpp"
#include "methods/method_info.hpp"

namespace argand {

/// relMSE of an image of n passes by an ErrorLaw (methods/method_info.hpp). A render that continues
/// a pilot made its first `initial_passes` passes with the initial bandwidth, that of a render of
/// one pass. Their noise and bias are part of the mean.
struct ErrorModel {
    double fixed = 0;   ///< variance of one pass that no bandwidth changes: eye paths, direct light
    double density = 0; ///< variance of one pass at the initial bandwidth: photons
    Estimate bias{0, 0};  ///< squared, at the initial bandwidth
    double estimated = 0; ///< variance of one pass in estimated light, at the initial bandwidth
    double initial_passes = 0;         ///< passes at the initial bandwidth
    ErrorLaw law = photon_mapping_law; ///< the exponents of n
};

/// Variance of the mean of `passes` passes.
double noise_after(const ErrorModel& model, double passes);
/// Squared bias at the bandwidth of a render of `passes` passes, divided by that of one pass.
double bias_at(const ErrorLaw& law, double passes);
/// Squared bias after `passes` passes, divided by that of one pass. The first `initial_passes` of
/// them have the initial bandwidth.
double bias_share(const ErrorLaw& law, double passes, double initial_passes = 0);
/// Squared bias of the mean of `passes` passes.
Estimate bias_after(const ErrorModel& model, double passes);
/// relMSE of the mean of `passes` passes.
double error_after(const ErrorModel& model, double passes);

/// Number of passes, at least 1 and not rounded, after which the error is at most `error`. Infinite
/// beyond 10^9 passes.
double passes_for(const ErrorModel& model, double error);

/// Fits the noise of the model, without bias, to the variance of one pass at the initial bandwidth
/// and at the bandwidth for `passes` > 1 passes. Clamps negative terms, which noisy variances may
/// yield, to 0.
ErrorModel fit_noise(double variance_at_one, double variance_at_passes, double passes,
                     const ErrorLaw& law = photon_mapping_law);

} // namespace argand
