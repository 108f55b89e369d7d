#pragma once

#include "accel/kdtree.hpp"
#include "device/count.hpp"
#include "device/device.hpp"

#include <optional>

namespace argand {

/// What tells rays how much of the surface is there where they meet a triangle
/// (shaders/comp/accel/alpha_bindings.glsl).
struct AlphaSurfaces {
    Buffer scene, triangles, materials, attributes, textures, texels;
    bool textured = false, vertex_colors = false;
};

/// Acceleration structure over triangles, for rays: a four-wide tree, or a kd-tree.
struct TriangleBvh {
    Buffer nodes;     ///< RayNode per inner node; none with a kd-tree
    Buffer triangles; ///< RayTriangle, in the order of the leaves; with a kd-tree in the scene's
    std::uint32_t triangle_count = 0;
    // Only if the triangles move:
    Buffer order;   ///< uint: of each leaf the triangle's index in the scene
    Buffer parents; ///< uint: of each child reference its place among all nodes' children
    Buffer boxes;   ///< of each child reference: vec4 (low, cost), vec4 (high, 0)
    KdTree kdtree;  ///< with words if rays go through it
    std::optional<AlphaSurfaces> alpha; ///< if parts of surfaces are absent; else all are opaque
};

/// Builds the structure on the device; records only. positions: vec4 (xyz) per vertex; triangles:
/// uvec4 (three vertices, material) per triangle. moves: refit_triangle_bvh() is to be called.
/// Without triangles rays hit nothing. Throws Error for more than max_ray_nodes triangles.
TriangleBvh build_triangle_bvh(Device& device, const Buffer& positions, const Buffer& triangles,
                               std::uint32_t count, bool moves = false);

/// Builds a kd-tree over the triangles, through which rays hit the same, to the bit. It cannot be
/// refitted. Waits for the device. Throws Error if settings.memory does not hold one leaf.
TriangleBvh build_triangle_kdtree(Device& device, const Buffer& positions, const Buffer& triangles,
                                  std::uint32_t count, const KdTreeSettings& settings);

/// Fits the structure to the same triangles at other positions, or with their vertices in another
/// order. Rays then hit the same as with a structure that is built anew; but the farther triangles
/// have moved from their neighbours, the more nodes they visit: see traversal_cost(). Requires a
/// structure built for triangles that move. Records only.
void refit_triangle_bvh(Device& device, const TriangleBvh& bvh, const Buffer& positions,
                        const Buffer& triangles);

/// Cost of the structure by the surface area heuristic: the half areas of its nodes, and half of
/// those of its triangles' boxes. Random lines through space visit nodes in proportion to it. It is
/// not divided by the area of the root, which grows where an object leaves the others and spoils
/// the nodes that hold both. 0 for fewer than two triangles. Requires a structure built for
/// triangles that move. Waits for the device.
double traversal_cost(Device& device, const TriangleBvh& bvh);

/// Working memory of traversal. A ray that uses up its steps in one dispatch is suspended, and the
/// next dispatch of the same call resumes it. `unfinished` counts rays that are not done then
/// either. Their results are wrong, and the caller has to repeat its work with `careful` set. Only
/// degenerate scenes need that.
struct Traversal {
    Buffer unfinished;       ///< one uint, which the caller clears
    Buffer suspended;        ///< see suspended_head in shared/accel_records.h
    std::uint32_t slots = 0; ///< rays that can be suspended at a time
    /// Boxes and triangles that a ray visits in one dispatch, at most. Lavapipe ends loops after
    /// 65,535 iterations.
    std::uint32_t step_limit = 16384;
    bool careful = false; ///< each call waits for the device, and resumes rays until all are done
};
Traversal make_traversal(Device& device, std::uint64_t max_rays);

/// The rays active[i] for i < count, and where their results go. It refers to the buffers.
struct RayBatch {
    const Buffer& rays;    ///< RayRecord
    const Buffer& active;  ///< uint: indices of rays
    const Buffer& results; ///< an element per ray, at the ray's index
    Count count;
};

/// Finds the closest hit of each ray; results: HitRecord. Of hits at one distance, the triangle
/// that comes first in the scene counts. If surfaces have alpha, rays find what is there in part,
/// and go on behind it where t_max is goes_on; they do not hit what is absent. Records only, unless
/// the traversal is careful.
void trace_closest(Device& device, const TriangleBvh& bvh, Traversal& traversal,
                   const RayBatch& batch);

/// Finds whether anything lies on each ray; results: uint, 1 or 0. Rays with t_max < 0 give 1. If
/// surfaces have alpha, results are the thickness of what lies on the ray (shared/alpha.h).
/// Records only, unless the traversal is careful.
void trace_any(Device& device, const TriangleBvh& bvh, Traversal& traversal, const RayBatch& batch);

} // namespace argand
