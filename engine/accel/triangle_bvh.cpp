#include "accel/triangle_bvh.hpp"

#include "accel/lbvh.hpp"
#include "base/error.hpp"
#include "kernels/ray_nodes.hpp"
#include "kernels/ray_triangles.hpp"
#include "kernels/triangle_boxes.hpp"
#include "kernels/wide_roots.hpp"
#include "parallel/parts.hpp"
#include "parallel/scan.hpp"
#include "shared/accel_records.h"
#include "shared/geometry_records.h"

#include <algorithm>

namespace argand {

namespace {

Buffer boxes_of(Device& device, const Buffer& positions, const Buffer& triangles,
                std::uint32_t count) {
    Buffer boxes = device.scratch("triangle bvh: boxes",
                                  std::max<std::uint64_t>(count, 1) * sizeof(BoxRecord));
    dispatch(device,
             kernels::triangle_boxes{.positions = positions,
                                     .triangles = triangles,
                                     .boxes = boxes,
                                     .params = {count_record(count)}},
             count);
    return boxes;
}

/// Writes the nodes and triangles that rays traverse.
void collapse(Device& device, const Lbvh& tree, const TriangleBvh& bvh, const Buffer& positions,
              const Buffer& triangles) {
    const std::uint32_t count = bvh.triangle_count;
    const AccelParams params{count_record(count)};
    const Buffer ranks = device.scratch("triangle bvh: ranks",
                                        std::max<std::uint64_t>(count, 1) * sizeof(std::uint32_t));
    const std::uint64_t inner = count > 0 ? count - 1 : 0;
    dispatch(device,
             kernels::wide_roots{
                 .costs = tree.costs, .parents = tree.parents, .roots = ranks, .params = params},
             inner);
    inclusive_scan(device, ranks, ranks, inner);
    dispatch(device,
             kernels::ray_nodes{.tree = tree.nodes,
                                .costs = tree.costs,
                                .ranks = ranks,
                                .nodes = bvh.nodes,
                                .params = params},
             inner);
    dispatch(device,
             kernels::ray_triangles{.positions = positions,
                                    .triangles = triangles,
                                    .order = tree.order,
                                    .leaf_triangles = bvh.triangles,
                                    .params = params},
             count);
}

} // namespace

TriangleBvh build_triangle_bvh(Device& device, const Buffer& positions, const Buffer& triangles,
                               std::uint32_t count, bool moves) {
    if (count > max_ray_nodes) {
        fail("building the acceleration structure: {} triangles are more than the {} it can hold; "
             "simplify "
             "the scene",
             count, max_ray_nodes);
    }
    const std::uint64_t bound = std::max<std::uint64_t>(count, 1);
    TriangleBvh bvh{.nodes = device.allocate("triangle bvh nodes", bound * sizeof(RayNode)),
                    .triangles =
                        device.allocate("triangle bvh triangles", bound * sizeof(RayTriangle)),
                    .triangle_count = count,
                    .binary = {}};
    const Buffer boxes = boxes_of(device, positions, triangles, count);
    const Lbvh tree = build_lbvh(device, boxes, count, {.rays = true, .refit = moves});
    collapse(device, tree, bvh, positions, triangles);
    if (moves) {
        bvh.binary = tree;
    }
    return bvh;
}

void refit_triangle_bvh(Device& device, const TriangleBvh& bvh, const Buffer& positions,
                        const Buffer& triangles) {
    const Buffer boxes = boxes_of(device, positions, triangles, bvh.triangle_count);
    refit_lbvh(device, bvh.binary, boxes, bvh.triangle_count);
    collapse(device, bvh.binary, bvh, positions, triangles);
}

double traversal_cost(Device& device, const TriangleBvh& bvh) {
    if (bvh.triangle_count < 2) {
        return 0;
    }
    return download<ForestCost>(device, bvh.binary.costs, 1)[0].one;
}

} // namespace argand
