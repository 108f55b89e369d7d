#pragma once

#include "autotune/witness.hpp"

#include <optional>

namespace argand {

/// The error of an image, measured while it is rendered.
struct MeasuredError {
    double passes = 0;                  ///< after which it was measured
    double noise = 0;                   ///< relMSE that is due to noise
    Estimate bias{0, 0};                ///< squared
    std::optional<Testimony> testimony; ///< of the witness, if there is one so far
    double error() const { return noise + bias.value; }
};

/// The error of the mean of the pilot's passes: noise by its halves, bias by its model. Requires
/// two passes.
MeasuredError error_of(const Pilot& pilot, const ErrorModel& model, const Image& guess);

} // namespace argand
