#pragma once

#include "imagespace/cube_maps.hpp"

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

namespace argand {

/// How many maps are chosen.
struct CenterSettings {
    std::uint32_t least = 1; ///< maps, if there are so many candidates; at most `most`
    std::uint32_t most = 30; ///< maps; at most most_centers
    /// Maps are added until they show this share of the points that candidates see, and until none
    /// adds more than the rest to the area that they show.
    double coverage = 0.99;
};

/// The masks of what chosen maps see have 32 bits: one for the map that is tried, and one of what
/// any candidate sees.
inline constexpr std::uint32_t most_centers = 30;

/// The chosen centers, and how the choice came about.
struct ChosenCenters {
    std::vector<std::size_t> candidates; ///< in the order in which they were chosen
    double missing = 0; ///< share of the points that candidates see and no chosen map does
    std::vector<std::size_t> unseen; ///< points that no candidate sees
    std::uint32_t rounds = 0;        ///< in which a map was added and one was dropped
};

/// Chooses centers that show as much as possible (Yao et al. 2010, section 4): first, greedily, the
/// candidate that shows the most of what those before do not; then one is added and the one is
/// dropped that shows the least alone, until one adds hardly more than the other showed. Candidates
/// that mostly see surfaces from behind are not chosen, unless all do. What counts is, one half
/// each, the area of the surfaces, as in the paper, and the number of `points`: a room on a large
/// ground is small, but there the photons may be. Without points it is the area alone. candidates:
/// their maps, of one layer and an even size. fixed: how many of them, from the first on, are
/// chosen in any case; less than settings.most. Waits for the device.
ChosenCenters choose_centers(Device& device, const DeviceScene& scene, const CubeMaps& candidates,
                             std::size_t fixed, std::span<const glm::vec4> points,
                             const CenterSettings& settings);

/// The points that no map of a scene shows. maps: of one layer and an even size. Waits for the
/// device.
std::vector<std::size_t> unseen_points(Device& device, const DeviceScene& scene,
                                       const CubeMaps& maps, std::span<const glm::vec4> points);

/// Points in a box, all the same for a seed.
std::vector<glm::vec3> random_centers(const Bounds& box, std::uint32_t count, std::uint32_t seed);

} // namespace argand
