#pragma once

#include "device/count.hpp"
#include "device/device.hpp"

namespace argand {

/// Acceleration structure over triangles, for rays.
struct TriangleBvh {
    Buffer nodes;     ///< RayNode per inner node
    Buffer triangles; ///< RayTriangle, in the order of the leaves
    std::uint32_t triangle_count = 0;
};

/// Builds the structure on the device. positions: vec4 (xyz) per vertex; triangles: uvec4 (three
/// vertices, material) per triangle. No triangle is fine: then nothing is ever hit. Records only.
TriangleBvh build_triangle_bvh(Device& device, const Buffer& positions, const Buffer& triangles,
                               std::uint32_t count);

/// Working memory of traversal. A ray that uses up a dispatch's share of steps is put aside and
/// gone on with in the next dispatch of the same call; `unfinished` (uint, the caller clears it)
/// counts rays that were still not done after it: their results are wrong, and the caller repeats
/// its work with `careful` set, where each call waits for the device and goes on until every ray is
/// done. Only degenerate scenes ever need that.
struct Traversal {
    Buffer unfinished;
    Buffer suspended;        ///< see suspended_head in shared/accel_records.h
    std::uint32_t slots = 0; ///< rays that can be put aside
    /// Boxes and triangles that a ray visits in one dispatch; lavapipe ends loops after 65,535
    /// iterations.
    std::uint32_t step_limit = 16384;
    bool careful = false;
};
Traversal make_traversal(Device& device, std::uint64_t max_rays);

/// For each i < count and r = active[i]: hits[r] (HitRecord) = the closest hit of rays[r]
/// (RayRecord). Of hits at one distance the triangle that comes first in the scene counts. Records
/// only, unless `careful`.
void trace_closest(Device& device, const TriangleBvh& bvh, Traversal& traversal, const Buffer& rays,
                   const Buffer& active, const Buffer& hits, const Count& count);

/// For each i < count and r = active[i]: occluded[r] (uint) = 1 if anything lies on rays[r], else
/// 0; rays with t_max < 0 give 1. Records only, unless `careful`.
void trace_any(Device& device, const TriangleBvh& bvh, Traversal& traversal, const Buffer& rays,
               const Buffer& active, const Buffer& occluded, const Count& count);

} // namespace argand
