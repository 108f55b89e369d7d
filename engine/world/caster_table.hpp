#pragma once

#include "device/device.hpp"
#include "scene/scene.hpp"

#include <cstdint>
#include <vector>

namespace argand {

/// The casters of caustics of a scene: its connected surfaces whose light is followed (glass,
/// mirrors, and what is nearly one). Triangles are connected if they have a corner at the same
/// place: in world space where they stand still, else in the object space of the node or the skin
/// that moves both. So the table does not depend on the moment.
struct CasterTable {
    std::vector<Bounds> at_rest; ///< boxes of the casters that do not move
    // Of those that move:
    Buffer vertices; ///< uint: the indices of their vertices
    Buffer parts;    ///< CasterPart
    std::vector<std::uint32_t> caster_of_part;
    std::uint32_t moving = 0; ///< number of casters

    bool empty() const { return at_rest.empty() && moving == 0; }
};

/// For each material whether its light is followed.
std::vector<bool> are_followed(const Scene& scene, float follow_roughness);

/// The casters among the triangles of materials that are followed. Records only.
CasterTable make_caster_table(Device& device, const Scene& scene,
                              const std::vector<bool>& followed);

/// Bounding spheres (center, radius) of all casters, where their vertices are now. positions: vec4
/// per vertex, on the device. Waits for the device if casters move.
std::vector<glm::vec4> caster_spheres(Device& device, const CasterTable& table,
                                      const Buffer& positions);

} // namespace argand
