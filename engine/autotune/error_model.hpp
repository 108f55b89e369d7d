#pragma once

#include "autotune/estimate.hpp"
#include "methods/method.hpp"

namespace argand {

/// relMSE of a picture of n passes. Widths of estimation shrink as n^(-1/6) (photon/radius.hpp),
/// areas as n^(-1/3), and noise of density estimation grows with one over the area. Squared bias
/// falls as n^(-2/3) where it goes with the area, on smooth surfaces, and as n^(-1/6) along edges,
/// in bands as wide as the widths. Together about n^(-1/3), as measured (docs/results/targets.md):
///   E(n) = (fixed + density n^(1/3)) / n + bias n^(-1/3).
/// The first `wide` passes are at the widths for one pass instead; their noise and bias are part of
/// the mean of all.
struct ErrorModel {
    double fixed = 0;   ///< variance of one pass that widths do not change: eye paths, direct light
    double density = 0; ///< variance of one pass at the widths for one pass: photons
    Estimate bias{0, 0}; ///< squared, at the widths for one pass
    double estimated =
        0; ///< part of the variance of one pass, at the widths for one, that is in estimated light
    double wide = 0; ///< passes that were made before it was known how many there will be
    ErrorLaw law = photon_mapping_law;
};

double noise_after(const ErrorModel& model, double passes);
/// Squared bias after so many passes, the first `wide` at the widths for one, over that at the
/// widths for one.
double bias_share(const ErrorLaw& law, double passes, double wide = 0);
Estimate bias_after(const ErrorModel& model, double passes);
double error_after(const ErrorModel& model, double passes);

/// Passes, at least 1 and not rounded, after which the error is at most `error`; infinite beyond
/// 10^9.
double passes_for(const ErrorModel& model, double error);

/// The model, but for bias, from the variance of one pass at the widths for one pass and for
/// `passes` > 1. Without negative terms: estimates may be.
ErrorModel fit_noise(double variance_at_one, double variance_at_passes, double passes,
                     const ErrorLaw& law = photon_mapping_law);

} // namespace argand
