#include "accel/triangle_bvh.hpp"

#include "accel/lbvh.hpp"
#include "kernels/ray_nodes.hpp"
#include "kernels/ray_triangles.hpp"
#include "kernels/triangle_boxes.hpp"
#include "shared/accel_records.h"
#include "shared/geometry_records.h"

#include <algorithm>

namespace argand {

TriangleBvh build_triangle_bvh(Device& device, const Buffer& positions, const Buffer& triangles,
                               std::uint32_t count) {
    const std::uint64_t bound = std::max<std::uint64_t>(count, 1);
    TriangleBvh bvh{.nodes = device.allocate("triangle bvh nodes", bound * sizeof(RayNode)),
                    .triangles = device.allocate("triangle bvh triangles", bound * sizeof(RayTriangle)),
                    .triangle_count = count};
    const Buffer boxes = device.allocate("triangle boxes", bound * sizeof(BoxRecord));
    const AccelParams params{.count = count, .count_index = no_count_index};
    dispatch(device,
             kernels::triangle_boxes{
                 .positions = positions, .triangles = triangles, .boxes = boxes, .params = params},
             count);
    const Lbvh tree = build_lbvh(device, boxes, count);
    dispatch(device, kernels::ray_nodes{.tree = tree.nodes, .nodes = bvh.nodes, .params = params},
             count > 0 ? count - 1 : 0);
    dispatch(device,
             kernels::ray_triangles{.positions = positions,
                                    .triangles = triangles,
                                    .order = tree.order,
                                    .leaf_triangles = bvh.triangles,
                                    .params = params},
             count);
    return bvh;
}

} // namespace argand
