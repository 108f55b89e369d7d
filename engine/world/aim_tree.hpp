#pragma once

#include "shared/aim_records.h"

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

namespace argand {

/// The random numbers in [0,1) that decide direction (x, y) and start (z, w) of a photon, and how
/// much light in the picture such photons bring.
struct AimSample {
    glm::dvec4 u{0};
    double weight = 0;
};

/// A density over the unit hypercube that follows these samples, as nodes of which the first is the
/// root: children come after their node. first_axis: the least axis that may be divided; 2 for
/// lights of one direction. A quarter of all photons is spread evenly, whatever was learnt, and a
/// fifth of each node's over the node, so that density falls off around what was found as far as
/// few samples tell (as a hierarchical Dirichlet prior smooths). A single node: nothing was learnt.
std::vector<AimNode> make_aim_tree(std::span<const AimSample> samples, int first_axis);

/// Nodes of a tree at most.
inline constexpr std::size_t most_aim_nodes = 511;

/// Whether these are such nodes; loaded ones need not be.
bool is_aim_tree(std::span<const AimNode> nodes);

/// How the photons of a light from outside are aimed. They start on discs around a point, before a
/// sphere that contains the scene.
struct LightAim {
    std::uint32_t row = 0; ///< of the light table
    glm::vec3 middle{0};   ///< of the discs
    std::vector<AimNode> tree;
};

} // namespace argand
