#pragma once

#include "device/device.hpp"
#include "scene/scene.hpp"
#include "shared/photon_records.h"

#include <cstdint>
#include <limits>

namespace argand {

/// A part of the scene in which areas are sampled.
struct SampledPart {
    glm::vec3 center{0};
    double reach = std::numeric_limits<double>::infinity(); ///< distance from there
};

/// The surfaces of a scene on which photons may lie, on a device. It shares the scene's buffers.
struct PhotonSurfaces {
    Buffer positions; ///< vec4 per vertex
    Buffer triangles; ///< uvec4 per triangle: vertices, material
    /// vec2 per triangle, whose sum is the area; 0 for mirrors, glass and what is black, and for
    /// duplicates with the same front, of which rays hit only the first.
    Buffer areas;
    std::uint32_t triangle_count = 0;
    Bounds box; ///< of the scene
};

/// Where area samples lie: along a space-filling curve, so that equal steps of area are evenly
/// spread over the surfaces whatever the order of the file.
struct SampledAreas {
    Buffer sums;              ///< AreaSumRecord per piece of a surface
    std::uint32_t pieces = 0; ///< in `sums`
    double area = 0;          ///< of these pieces
    SampledPart part;         ///< in which they lie; by default everywhere
};

/// Finds the areas of the surfaces on which photons may lie. positions, triangles, box: the
/// scene's, as in PhotonSurfaces. Records only.
PhotonSurfaces find_photon_surfaces(Device& device, const Scene& scene, const Buffer& positions,
                                    const Buffer& triangles, const Bounds& box,
                                    float follow_roughness);

/// Lets area samples lie in a part of the scene only: they can be as dense there as a small radius
/// requires. The table contains all of the surfaces that lie within the part, and little else:
/// large triangles are divided into pieces for that. Sums are in fixed point, so that their bits
/// do not depend on scheduling. Waits for the device.
SampledAreas sample_areas(Device& device, const PhotonSurfaces& surfaces, const SampledPart& part);

} // namespace argand
