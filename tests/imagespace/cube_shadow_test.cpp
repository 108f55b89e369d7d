// Shadow rays through cube maps against those through the tree.
#include "mapped_scene.hpp"
#include "shared/alpha.h"
#include "shared/image_space_records.h"

#include <cmath>
#include <gtest/gtest.h>
#include <numeric>

namespace argand::testing {
namespace {

/// Rays that leave surfaces for a light, and the hits that they leave.
struct ShadowRays {
    std::vector<RayRecord> rays;
    std::vector<HitRecord> hits;
};

class CubeShadows : public MappedScene {
protected:
    /// Rays from what random rays from `eye` hit, each to a point about `light`.
    ShadowRays rays_to(glm::vec3 light, float extent, glm::vec3 eye, std::size_t count) {
        std::mt19937 random(5);
        std::normal_distribution<float> normal;
        std::uniform_real_distribution<float> within(-extent, extent);
        std::vector<RayRecord> eye_rays;
        while (eye_rays.size() < count) {
            const glm::vec3 direction(normal(random), normal(random), normal(random));
            eye_rays.push_back(ray_from(eye, glm::normalize(direction)));
        }
        Traversal traversal = make_traversal(open(), count);
        open().fill(traversal.unfinished, 0);
        const Buffer found = open().allocate("hits", count * sizeof(HitRecord));
        trace_closest(open(), scene_.bvh, traversal,
                      {upload(open(), "rays", eye_rays), all_of(count), found, count});
        ShadowRays result;
        for (const HitRecord& hit : download<HitRecord>(open(), found, count)) {
            if (hit.triangle == no_triangle) {
                continue;
            }
            const auto t = loaded_.triangles[hit.triangle];
            const glm::vec3 a = loaded_.positions[t.x];
            const glm::vec3 b = loaded_.positions[t.y];
            const glm::vec3 c = loaded_.positions[t.z];
            glm::vec3 error;
            const glm::vec3 place = hit_point(a, b, c, hit.u, hit.v, error);
            const glm::vec3 normal_of = glm::normalize(glm::cross(b - a, c - a));
            const glm::vec3 end = light + glm::vec3(within(random), within(random), within(random));
            const glm::vec3 origin = offset_ray_origin(place, error, normal_of, end - place);
            // Light from behind is not asked for.
            if (glm::dot(normal_of, end - place) * glm::dot(normal_of, eye - place) > 0) {
                result.rays.push_back(
                    ray_from(origin, glm::normalize(end - origin), glm::length(end - origin)));
                result.hits.push_back(hit);
            }
        }
        return result;
    }

    /// at_lights: how many of the first centers are point lights.
    std::vector<std::uint32_t> by_maps(const CubeMaps& maps, std::size_t at_lights,
                                       const ShadowRays& from) {
        const std::size_t count = from.rays.size();
        const Buffer found = open().allocate("shadows", std::max<std::size_t>(count, 1) * 4);
        const Buffer hits =
            upload(open(), "hits", from.hits.empty() ? std::vector<HitRecord>(1) : from.hits);
        trace_cube_shadows(open(), scene_, maps, at_lights, {}, hits,
                           {upload(open(), "rays", from.rays), all_of(count), found, count});
        return download<std::uint32_t>(open(), found, count);
    }

    /// As thicknesses, also in scenes without alpha.
    std::vector<std::uint32_t> by_tree(const ShadowRays& from) {
        const std::size_t count = from.rays.size();
        Traversal traversal = make_traversal(open(), count);
        open().fill(traversal.unfinished, 0);
        const Buffer found = open().allocate("shadows", count * 4);
        trace_any(open(), scene_.bvh, traversal,
                  {upload(open(), "rays", from.rays), all_of(count), found, count});
        std::vector<std::uint32_t> thicknesses = download<std::uint32_t>(open(), found, count);
        for (std::uint32_t& thickness : thicknesses) {
            thickness = !scene_.bvh.alpha && thickness != 0 ? thickness_of_all : thickness;
        }
        return thicknesses;
    }

    struct Comparison {
        double same = 0;                ///< share of the rays by which as much light passes, to 1 %
        double found = 0, expected = 0; ///< means of the light that passes
    };

    Comparison compare(const CubeMaps& maps, std::size_t at_lights, const ShadowRays& rays) {
        const std::vector<std::uint32_t> found = by_maps(maps, at_lights, rays);
        const std::vector<std::uint32_t> expected = by_tree(rays);
        Comparison c;
        for (std::size_t i = 0; i < found.size(); ++i) {
            const double a = transmittance(found[i]);
            const double b = transmittance(expected[i]);
            const double share = 1 / static_cast<double>(found.size());
            c.same += std::abs(a - b) < 0.01 ? share : 0;
            c.found += a * share;
            c.expected += b * share;
        }
        return c;
    }

private:
    Buffer all_of(std::size_t count) {
        std::vector<std::uint32_t> active(count);
        std::iota(active.begin(), active.end(), 0u);
        return upload(open(), "active", active);
    }
};

TEST_F(CubeShadows, MapsAroundAPointLightAreItsShadowMaps) {
    const glm::vec3 light(0.3f, 1.7f, 0.2f);
    for (const char* name : {"cornell_point.glb", "cornell_glass.glb", "smooth_sphere.glb"}) {
        load(name);
        const ShadowRays rays = rays_to(light, 0, {0, 1, 0.7f}, 10'000);
        ASSERT_GT(rays.rays.size(), 2000u);
        const Comparison found = compare(cast({light, {-0.5f, 1, 0}}, 256), 1, rays);
        EXPECT_GT(found.same, 0.97) << name; // but for texels on the shadows' edges
        EXPECT_NEAR(found.found, found.expected, 0.005) << name;
        EXPECT_LT(found.expected, 0.97) << name; // there are shadows
        const Comparison coarse = compare(cast({light}, 16), 1, rays);
        EXPECT_LT(coarse.same, found.same) << name;
        EXPECT_NEAR(coarse.found, coarse.expected, 0.05) << name;
    }
}

TEST_F(CubeShadows, EdgesAreFiltered) {
    load("cornell_point.glb");
    const glm::vec3 light(0.3f, 1.7f, 0.2f);
    const ShadowRays rays = rays_to(light, 0, {0, 1, 0.7f}, 10'000);
    double between = 0;
    for (const std::uint32_t thickness : by_maps(cast({light}, 32), 1, rays)) {
        const double passed = transmittance(thickness);
        between += passed > 0.01 && passed < 0.99 ? 1 : 0;
    }
    EXPECT_GT(between, 0.02 * static_cast<double>(rays.rays.size()));
}

TEST_F(CubeShadows, OtherRaysAreSearchedFor) {
    const glm::vec3 lamp(0, 1.9f, 0);
    for (const char* name : {"cornell_area.glb", "cornell_glass.glb"}) {
        load(name);
        const ShadowRays rays = rays_to(lamp, 0.09f, {0, 1, 0.7f}, 4000);
        const Comparison found = compare(
            cast({{0.3f, 1.2f, 0.6f}, {-0.7f, 1.6f, -0.6f}, {0.7f, 0.3f, 0.7f}}, 128), 0, rays);
        EXPECT_GT(found.same, 0.97) << name;
        EXPECT_NEAR(found.found, found.expected, 0.02) << name;
    }
}

TEST_F(CubeShadows, AShareOfTheLightPassesWhatIsPartlyThere) {
    load("veil.glb");
    const glm::vec3 light(-0.2f, 0.7f, 0.95f); // before the pane
    const ShadowRays rays = rays_to(light, 0, {0, 0.5f, 0.3f}, 10'000);
    ASSERT_GT(rays.rays.size(), 2000u);
    const std::vector<std::uint32_t> expected = by_tree(rays);
    EXPECT_GT(std::count_if(expected.begin(), expected.end(),
                            [](std::uint32_t t) { return t > 0 && t < most_thickness; }),
              100);
    for (const glm::vec3& center : {light, glm::vec3(0.3f, 1, 0.9f)}) { // mapped, searched for
        const Comparison found = compare(cast({center}, 256), center == light ? 1 : 0, rays);
        EXPECT_GT(found.same, 0.95);
        EXPECT_NEAR(found.found, found.expected, 0.02);
    }
}

TEST_F(CubeShadows, AnyNumberOfRaysAndIdleOnes) {
    load("cornell_point.glb");
    const glm::vec3 light(0.3f, 1.7f, 0.2f);
    const CubeMaps maps = cast({light}, 33);
    EXPECT_TRUE(by_maps(maps, 1, {}).empty());
    ShadowRays rays = rays_to(light, 0, {0, 1, 0.7f}, 300);
    for (const std::size_t count : {1u, 65u, 101u}) {
        ShadowRays some = rays;
        some.rays.resize(count);
        some.hits.resize(count);
        some.rays[0].t_max = -1;
        EXPECT_EQ(by_maps(maps, 1, some).front(), thickness_of_all);
    }
    // From far away, to the sun, and nowhere.
    rays.rays = {ray_from({1e18f, 0, 0}, {0, 1, 0}), ray_from({0, 5, 0}, {0, 1, 0}),
                 ray_from({0, 1, 0.5f}, {0, -1, 0}), ray_from({0, 1, 0}, {0, 0, 0}, 1)};
    rays.hits.assign(4, HitRecord{no_triangle, 0, 0, 0});
    const std::vector<std::uint32_t> found = by_maps(maps, 1, rays);
    EXPECT_EQ(found[0], 0u);
    EXPECT_EQ(found[1], 0u);
    EXPECT_EQ(found[2], thickness_of_all); // the floor
}

} // namespace
} // namespace argand::testing
