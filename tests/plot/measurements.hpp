#pragma once

#include "sweep/results.hpp"

#include <string>

namespace argand::testing {

inline Measurement measurement(const std::string& method, double seconds, double error) {
    return {.method = method,
            .option = "default",
            .options = "--method " + method,
            .wall_seconds = seconds,
            .rel_mse = {error, 0},
            .ssim = {1, 0}};
}

/// Two points on the front, and one that is not, at the time of the second.
inline Results results() {
    return {.measurements = {measurement("path", 1, 0.1), measurement("photons", 10, 0.001),
                             measurement("photons", 10, 0.05)}};
}

} // namespace argand::testing
