#include "autotune/error_model.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace argand {

namespace {

/// n^power, or if each pass has its own bandwidth the mean of i^power over the passes i from 1 to n
/// (the first terms of Euler's and Maclaurin's formula).
double power_of_passes(const ErrorLaw& law, double passes, double power) {
    const double last = std::pow(passes, power);
    if (!law.by_pass) {
        return last;
    }
    const double integral = (passes * last - 1) / (power + 1);
    const double ends = 0.5 * (1 + last) + power / 12 * (last / passes - 1);
    return (integral + ends) / passes;
}

} // namespace

double noise_after(const ErrorModel& model, double passes) {
    const double initial = std::min(model.initial_passes, passes) / passes;
    const double growth = power_of_passes(model.law, passes, model.law.noise_growth);
    return (model.fixed + model.density * (initial + (1 - initial) * growth)) / passes;
}

double bias_at(const ErrorLaw& law, double passes) { return std::pow(passes, -law.bias_fall); }

double bias_share(const ErrorLaw& law, double passes, double initial_passes) {
    const double initial = std::min(initial_passes, passes) / passes;
    const double amplitude =
        initial + (1 - initial) * power_of_passes(law, passes, -0.5 * law.bias_fall);
    return amplitude * amplitude;
}

Estimate bias_after(const ErrorModel& model, double passes) {
    return scaled(model.bias, bias_share(model.law, passes, model.initial_passes));
}

double error_after(const ErrorModel& model, double passes) {
    return noise_after(model, passes) + bias_after(model, passes).value;
}

double passes_for(const ErrorModel& model, double error) {
    constexpr double most = 1e9;
    if (error_after(model, 1) <= error) {
        return 1;
    }
    if (!(error_after(model, most) <= error)) {
        return std::numeric_limits<double>::infinity();
    }
    // E(n) decreases: bisect in log n.
    double low = 1, high = most;
    while (high > 1.001 * low) {
        const double middle = std::sqrt(low * high);
        (error_after(model, middle) <= error ? high : low) = middle;
    }
    return high;
}

ErrorModel fit_noise(double variance_at_one, double variance_at_passes, double passes,
                     const ErrorLaw& law) {
    const double growth = std::pow(passes, law.noise_growth) - 1;
    const double density =
        std::clamp((variance_at_passes - variance_at_one) / growth, 0.0, variance_at_one);
    return {.fixed = std::max(variance_at_one - density, 0.0), .density = density, .law = law};
}

} // namespace argand
