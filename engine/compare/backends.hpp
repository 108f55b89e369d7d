#pragma once

#include "compare/comparison.hpp"
#include "device/device.hpp"
#include "methods/render.hpp"
#include "scene/scene.hpp"

#include <vector>

namespace argand {

/// Two backends' work on one picture.
struct BackendComparison {
    std::vector<StageComparison> isolated;      ///< every stage of the second on what the first had before it
    std::vector<StageComparison> end_to_end;    ///< the second on its own
    double rel_mse = 0;                         ///< of the second's picture, made by itself, against the first's
    double seconds_a = 0, seconds_b = 0;        ///< of rendering, the second time
};

/// Renders the scene on both devices, by themselves and side by side.
BackendComparison compare_backends(Device& a, Device& b, const Scene& scene, const RenderSettings& settings);

/// Whether all of a stage's items must be equal to the bit: integers, and floats that are copied or compared only.
bool must_be_equal(const StageComparison& stage);

/// Of a stage's items, the share that may have diverged where the second backend starts from the first one's input, and
/// where it goes on by itself.
inline constexpr double isolated_tolerance = 1e-4;
inline constexpr double end_to_end_tolerance = 1e-2;
/// Of the picture.
inline constexpr double picture_tolerance = 1e-3;

bool passes(const StageComparison& stage, double tolerance);
bool passes(const BackendComparison& comparison);

} // namespace argand
