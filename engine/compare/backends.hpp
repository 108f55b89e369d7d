#pragma once

#include "compare/comparison.hpp"
#include "compare/golden.hpp"
#include "device/device.hpp"
#include "methods/render.hpp"
#include "scene/scene.hpp"

#include <vector>

namespace argand {

/// Two backends' work on one picture.
struct BackendComparison {
    std::vector<StageComparison>
        isolated; ///< every stage of the second on what the first had before it
    std::vector<StageComparison> end_to_end; ///< the second on its own
    double rel_mse = 0; ///< of the second's picture, made by itself, against the first's
    double seconds_a = 0, seconds_b = 0; ///< of rendering, the second time
};

/// Renders the scene on both devices, by themselves and side by side.
BackendComparison compare_backends(Device& a, Device& b, const Scene& scene,
                                   const RenderSettings& settings);

/// What a device does while it renders the scene with these settings.
GoldenCapture record_golden(Device& device, const Scene& scene, const RenderSettings& settings);

/// The settings with which a capture was recorded.
RenderSettings settings_of(const Golden& golden, const std::string& method);

/// As BackendComparison::isolated, with the recorded device as the first one. Throws Error if the
/// scene or this version takes other stages than were recorded, or there is no capture of that
/// method.
std::vector<StageComparison> compare_with_golden(const Golden& golden, const std::string& method,
                                                 Device& device, const Scene& scene);

/// Whether all of a stage's items must be equal to the bit: integers, and floats with hardly any
/// arithmetic.
bool must_be_equal(const StageComparison& stage);

/// Of a stage's items, the share that may have diverged where the second backend starts from the
/// first one's input (they differ by more than 1e-5), and where it goes on by itself (1e-3).
inline constexpr double isolated_tolerance = 1e-4;
inline constexpr double end_to_end_tolerance = 1e-2;
/// Of the picture.
inline constexpr double picture_tolerance = 1e-5;

/// Whether a stage is the same on both, within what it is allowed.
bool passes_isolated(const StageComparison& stage);
bool passes_end_to_end(const StageComparison& stage);
bool passes(const BackendComparison& comparison);

} // namespace argand
