#pragma once

#include "compare/comparison.hpp"
#include "compare/golden.hpp"
#include "device/device.hpp"
#include "methods/render_settings.hpp"
#include "scene/scene.hpp"

#include <vector>

namespace argand {

/// Comparison of two backends that render the same image.
struct BackendComparison {
    /// Every stage of the second backend, run on the first one's input.
    std::vector<StageComparison> isolated;
    /// Every stage of the second backend, run on its own results.
    std::vector<StageComparison> end_to_end;
    double rel_mse = 0; ///< of the second backend's own image against the first one's
    double seconds_a = 0, seconds_b = 0; ///< of the second rendering on each backend
};

/// Renders the scene on each device separately and then on both side by side; where meshes move,
/// also at another moment, which refits the tree.
BackendComparison compare_backends(Device& a, Device& b, const Scene& scene,
                                   const RenderSettings& settings,
                                   MethodTable methods = builtin_methods());

/// Records the results of every stage while a device renders the scene with these settings.
GoldenCapture record_golden(Device& device, const Scene& scene, const RenderSettings& settings,
                            MethodTable methods = builtin_methods());

/// The settings with which a capture was recorded.
RenderSettings settings_of(const Golden& golden, const std::string& method);

/// Like BackendComparison::isolated, with the recorded device as the first one. Throws Error if the
/// scene or this version of Argand runs other stages than were recorded, or the file has no capture
/// of that method.
std::vector<StageComparison> compare_with_golden(const Golden& golden, const std::string& method,
                                                 Device& device, const Scene& scene,
                                                 MethodTable methods = builtin_methods());

/// Whether all items of a stage must be equal to the bit. True for integers, and for floats with
/// hardly any arithmetic.
bool must_be_equal(const StageComparison& stage);

/// Largest share of a stage's items that may diverge if the second backend starts from the first
/// one's input (items diverge if they differ by more than 1e-5), and if it continues from its own
/// (1e-3).
inline constexpr double isolated_tolerance = 1e-4;
inline constexpr double end_to_end_tolerance = 1e-2;
/// Largest relMSE between the images.
inline constexpr double image_tolerance = 1e-5;

/// Whether the differences of a stage, or of the whole comparison, are within these tolerances.
bool passes_isolated(const StageComparison& stage);
bool passes_end_to_end(const StageComparison& stage);
bool passes(const BackendComparison& comparison);

} // namespace argand
