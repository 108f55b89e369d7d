#pragma once

#include "device/count.hpp"
#include "device/device.hpp"

namespace argand {

/// Acceleration structure over triangles, for rays.
struct TriangleBvh {
    Buffer nodes;
    Buffer triangles;                   ///< in the order of the leaves
    std::uint32_t triangle_count = 0;
};

/// Builds the structure on the device. positions: vec4 (xyz) per vertex; triangles: uvec4 (three vertices, material)
/// per triangle. No triangle is fine: then nothing is ever hit. Records only.
TriangleBvh build_triangle_bvh(Device& device, const Buffer& positions, const Buffer& triangles, std::uint32_t count);

/// Working memory of traversal. A ray that uses up a dispatch's share of iterations is put aside and gone on with in the
/// next dispatch of the same call; `unfinished` (uint, the caller clears it) counts rays that were still not done after
/// it: their results are wrong, and the caller repeats its work with `careful` set, where each call waits for the
/// device and goes on until every ray is done. Only degenerate scenes ever need that.
struct Traversal {
    Buffer unfinished;
    Buffer suspended;
    bool careful = false;
};
Traversal make_traversal(Device& device, std::uint64_t max_rays);

/// For each i < count and r = active[i]: hits[r] (HitRecord) = the closest hit of rays[r] (RayRecord). Records only,
/// unless `careful`.
void trace_closest(Device& device, const TriangleBvh& bvh, Traversal& traversal, const Buffer& rays,
                   const Buffer& active, const Buffer& hits, const Count& count);

/// For each i < count and r = active[i]: occluded[r] (uint) = 1 if anything lies on rays[r], else 0; rays with
/// t_max < 0 give 1. Records only, unless `careful`.
void trace_any(Device& device, const TriangleBvh& bvh, Traversal& traversal, const Buffer& rays, const Buffer& active,
               const Buffer& occluded, const Count& count);

} // namespace argand
