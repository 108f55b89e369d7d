#include "autotune/measured_error.hpp"

#include "image/metrics.hpp"

#include <algorithm>
#include <cmath>

namespace argand {

MeasuredError error_of(const Pilot& pilot, const ErrorModel& model, const Image& guess) {
    const auto passes = static_cast<double>(pilot.passes);
    const double initial = std::min(passes, static_cast<double>(initial_pilot_passes)),
                 reduced = passes - initial;
    const double noise = (initial * rel_variance(pilot.initial.whole, guess, guess) +
                          reduced * rel_variance(pilot.reduced.whole, guess, guess)) /
                         (passes * passes);
    const double bias =
        (initial + reduced * std::sqrt(bias_at(model.law, reduced_for_passes))) / passes;
    return {
        .passes = passes, .noise = noise, .bias = scaled(model.bias, bias * bias), .testimony = {}};
}

} // namespace argand
