#include "accel/triangle_bvh.hpp"
#include "device_fixture.hpp"
#include "shared/accel_records.h"
#include "tracing.hpp"

namespace argand {
namespace {

using WideTree = VariantTest;

struct Box {
    glm::vec3 low{INFINITY};
    glm::vec3 high{-INFINITY};
};

/// Walks down from a node; returns the box of all triangles below it. Counts visits of triangles.
class Walk {
public:
    Walk(Device& device, const TriangleBvh& bvh)
        : nodes_(download<RayNode>(device, bvh.nodes, bvh.triangle_count)),
          triangles_(download<RayTriangle>(device, bvh.triangles, bvh.triangle_count)),
          seen(bvh.triangle_count) {}

    Box visit(std::uint32_t reference) {
        Box box;
        if ((reference & 1) != 0) {
            const RayTriangle& triangle = triangles_[reference >> 1];
            ++seen[triangle.triangle];
            for (const glm::vec3 corner : {glm::vec3(triangle.x0, triangle.y0, triangle.z0),
                                           glm::vec3(triangle.x1, triangle.y1, triangle.z1),
                                           glm::vec3(triangle.x2, triangle.y2, triangle.z2)}) {
                box.low = glm::min(box.low, corner);
                box.high = glm::max(box.high, corner);
            }
            return box;
        }
        const RayNode& node = nodes_[reference >> 1];
        ++inner;
        const std::uint32_t children[] = {node.child0, node.child1, node.child2, node.child3};
        const std::uint32_t count = node.scales >> 24;
        EXPECT_GE(count, 2u);
        EXPECT_LE(count, 4u);
        for (std::uint32_t i = 0; i < count; ++i) {
            const Box child = visit(children[i]);
            const glm::dvec3 low =
                corner(node, {node.low_cells_x, node.low_cells_y, node.low_cells_z}, i);
            const glm::dvec3 high =
                corner(node, {node.high_cells_x, node.high_cells_y, node.high_cells_z}, i);
            const glm::dvec3 cell = cells(node);
            // Within what make_ray in traverse.h allows for, and not a cell more than needed.
            const glm::dvec3 slack = 1e-6 * (glm::abs(glm::dvec3(child.low)) +
                                             glm::abs(glm::dvec3(child.high)) + 256.0 * cell);
            for (int axis = 0; axis < 3; ++axis) {
                EXPECT_LE(low[axis], child.low[axis] + slack[axis]);
                EXPECT_GE(high[axis], child.high[axis] - slack[axis]);
                EXPECT_GE(low[axis], child.low[axis] - cell[axis] - slack[axis]);
                EXPECT_LE(high[axis], child.high[axis] + cell[axis] + slack[axis]);
            }
            box.low = glm::min(box.low, child.low);
            box.high = glm::max(box.high, child.high);
        }
        return box;
    }

private:
    static glm::dvec3 cells(const RayNode& node) {
        return {std::ldexp(1.0, int(node.scales & 255) - 127),
                std::ldexp(1.0, int(node.scales >> 8 & 255) - 127),
                std::ldexp(1.0, int(node.scales >> 16 & 255) - 127)};
    }
    static glm::dvec3 corner(const RayNode& node, glm::uvec3 bytes, std::uint32_t child) {
        return glm::dvec3(node.low_x, node.low_y, node.low_z) +
               glm::dvec3((bytes >> (8 * child)) & 255u) * cells(node);
    }

    std::vector<RayNode> nodes_;
    std::vector<RayTriangle> triangles_;

public:
    std::vector<int> seen;
    std::size_t inner = 0;
};

void expect_sound(Device& device, const Mesh& mesh) {
    const Tracer tracer(device, mesh);
    Walk walk(device, tracer.bvh);
    walk.visit(mesh.triangles.size() > 1 ? 0 : 1);
    EXPECT_THAT(walk.seen, testing::Each(1));
}

TEST_P(WideTree, HoldsEachTriangleOnceInBoxesThatFit) {
    Device& device = open_variant();
    for (const std::size_t count : {1, 2, 3, 4, 5, 17, 1000, 20011}) {
        SCOPED_TRACE(count);
        expect_sound(device, random_triangles(count, 0.1f, 3));
    }
}

TEST_P(WideTree, HoldsScenesOfAnyScale) {
    Device& device = open_variant();
    for (const glm::vec3 scale : {glm::vec3(1e6f), glm::vec3(1e-6f), glm::vec3(1, 1, 0),
                                  glm::vec3(1, 0, 0), glm::vec3(0), glm::vec3(1e-20f, 1, 1e15f)}) {
        SCOPED_TRACE(scale.x);
        Mesh mesh = random_triangles(500, 0.1f, 4);
        for (glm::vec4& position : mesh.positions) {
            position = glm::vec4(glm::vec3(position) * scale + glm::vec3(3, -2, 0), 1);
        }
        expect_sound(device, mesh);
    }
}

TEST_P(WideTree, FillsItsNodes) {
    Device& device = open_variant();
    const Mesh mesh = random_triangles(20000, 0.02f, 5);
    const Tracer tracer(device, mesh);
    Walk walk(device, tracer.bvh);
    walk.visit(0);
    EXPECT_LT(walk.inner, mesh.triangles.size() / 2); // a third, if all were full
}

INSTANTIATE_VARIANTS(WideTree);

} // namespace
} // namespace argand
