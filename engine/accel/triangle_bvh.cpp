#include "accel/triangle_bvh.hpp"

#include "accel/fences.hpp"
#include "accel/lbvh.hpp"
#include "base/error.hpp"
#include "kernels/ray_nodes.hpp"
#include "kernels/ray_parents.hpp"
#include "kernels/ray_refit.hpp"
#include "kernels/ray_triangles.hpp"
#include "kernels/triangle_boxes.hpp"
#include "kernels/wide_roots.hpp"
#include "parallel/parts.hpp"
#include "parallel/scan.hpp"
#include "shared/accel_records.h"
#include "shared/geometry_records.h"

#include <algorithm>
#include <glm/glm.hpp>
#include <numeric>
#include <vector>

namespace argand {

namespace {

/// Prepares the structure for refit_triangle_bvh(). nodes: their number, a uint; order:
/// Lbvh::order.
void prepare_refit(Device& device, TriangleBvh& bvh, const Buffer& nodes, const Buffer& order) {
    const std::uint64_t references = 2 * std::max<std::uint64_t>(bvh.triangle_count, 1);
    bvh.order = order;
    bvh.parents = device.allocate("triangle bvh parents", references * sizeof(std::uint32_t));
    bvh.boxes = device.allocate("triangle bvh child boxes", references * sizeof(BoxRecord));
    device.fill(bvh.parents, lbvh_end);
    if (bvh.triangle_count > 1) {
        dispatch(
            device,
            kernels::ray_parents{.nodes = bvh.nodes, .node_count = nodes, .parents = bvh.parents},
            bvh.triangle_count - 1);
    }
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
                    .triangle_count = count};
    const Buffer boxes = device.scratch("triangle bvh: boxes", bound * sizeof(BoxRecord));
    const AccelParams params{count_record(count)};
    dispatch(device,
             kernels::triangle_boxes{
                 .positions = positions, .triangles = triangles, .boxes = boxes, .params = params},
             count);
    const Lbvh tree = build_lbvh(device, boxes, count, true);
    const Buffer ranks = device.scratch("triangle bvh: ranks", bound * sizeof(std::uint32_t));
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
    if (moves) {
        const Buffer node_count = device.scratch("triangle bvh: node count", sizeof(std::uint32_t));
        if (inner > 0) {
            device.copy({ranks, (inner - 1) * sizeof(std::uint32_t), sizeof(std::uint32_t)},
                        node_count);
        }
        prepare_refit(device, bvh, node_count, tree.order);
        refit_triangle_bvh(device, bvh, positions, triangles); // for its cost
    }
    return bvh;
}

TriangleBvh build_triangle_kdtree(Device& device, const Buffer& positions, const Buffer& triangles,
                                  std::uint32_t count, const KdTreeSettings& settings) {
    const std::uint64_t bound = std::max<std::uint64_t>(count, 1);
    TriangleBvh bvh{.triangles = device.allocate("kd-tree triangles", bound * sizeof(RayTriangle)),
                    .triangle_count = count};
    const Buffer boxes = device.scratch("triangle bvh: boxes", bound * sizeof(BoxRecord));
    const AccelParams params{count_record(count)};
    std::vector<std::uint32_t> order(count);
    std::iota(order.begin(), order.end(), 0u);
    if (count > 0) {
        dispatch(
            device,
            kernels::triangle_boxes{
                .positions = positions, .triangles = triangles, .boxes = boxes, .params = params},
            count);
        dispatch(device,
                 kernels::ray_triangles{.positions = positions,
                                        .triangles = triangles,
                                        .order = upload(device, "kd-tree: order", order),
                                        .leaf_triangles = bvh.triangles,
                                        .params = params},
                 count);
    }
    bvh.kdtree = build_kdtree(device, boxes, count, settings);
    return bvh;
}

void refit_triangle_bvh(Device& device, const TriangleBvh& bvh, const Buffer& positions,
                        const Buffer& triangles) {
    const std::uint32_t count = bvh.triangle_count;
    const Buffer arrivals = device.scratch(
        "triangle bvh: arrivals", std::max<std::uint64_t>(count, 1) * sizeof(std::uint32_t));
    device.fill(arrivals, 0);
    dispatch(device,
             kernels::ray_refit{.positions = positions,
                                .triangles = triangles,
                                .order = bvh.order,
                                .parents = bvh.parents,
                                .arrivals = arrivals,
                                .boxes = bvh.boxes,
                                .nodes = bvh.nodes,
                                .leaf_triangles = bvh.triangles,
                                .params = {count_record(count)},
                                .constants = {.fences = needs_fences(device)}},
             count);
}

double traversal_cost(Device& device, const TriangleBvh& bvh) {
    // The first half of the root's box: low and cost.
    return bvh.triangle_count < 2 ? 0 : download<glm::vec4>(device, bvh.boxes, 1)[0].w;
}

} // namespace argand
