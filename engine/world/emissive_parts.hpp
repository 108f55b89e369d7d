#pragma once

#include "device/device.hpp"
#include "scene/scene.hpp"
#include "shared/emissive_records.h"
#include "world/light_table.hpp"

#include <cstdint>
#include <vector>

namespace argand {

/// The emissive triangles of a scene whose lights a device makes, because some of them move or they
/// are many: their order, and which of them make up an emitter. It does not depend on the moment. A
/// part ends where the next triangle belongs to another emitter, so a file whose emitters alternate
/// has many.
struct EmissiveParts {
    Buffer triangles;                   ///< uint: the triangles, by rising index
    Buffer parts;                       ///< EmissivePart
    Buffer texels;                      ///< TexelMean of each triangle, if any has a texture
    std::vector<EmissivePart> ranges;   ///< of each part, as in `parts`
    std::vector<std::uint32_t> emitter; ///< of each part, from 0
    std::uint32_t triangle_count = 0, emitter_count = 0;
};

/// emitting: the triangles of materials that emit light, by rising index; texels: of those that do
/// by a texture.
/// Those are connected that have a corner at the same place in the space that moves both. Records
/// only.
EmissiveParts find_emissive_parts(Device& device, const Scene& scene,
                                  const std::vector<std::uint32_t>& emitting,
                                  const TexelTrees& texels);

/// Makes the lights of a scene in `lights` (LightRecord), where its vertices are now on the device:
/// the host does nothing for a triangle. positions, triangles, materials: as in DeviceScene.
/// scene_radius: see make_light_table(). Waits for the device.
LightTable make_light_table(Device& device, const Scene& scene, const EmissiveParts& emissive,
                            const Buffer& positions, const Buffer& triangles,
                            const Buffer& materials, float scene_radius, Buffer& lights);

/// The tables (LightChoice) for choosing a light of this table for shadow rays and, behind it, for
/// photons. rays, photons: light_choices() of the rows. Records only.
Buffer choices_of_lights(Device& device, const LightTable& table, const EmissiveParts& emissive,
                         const Buffer& lights, const std::vector<LightChoice>& rays,
                         const std::vector<LightChoice>& photons);

} // namespace argand
