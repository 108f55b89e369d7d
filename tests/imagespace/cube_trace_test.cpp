// Hits in cube maps against those of the tree.
#include "imagespace/cube_centers.hpp"
#include "mapped_scene.hpp"
#include "shared/image_space_records.h"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <numeric>
#include <random>

namespace argand::testing {
namespace {

/// Rays from points in a box around the origin.
std::vector<RayRecord> random_rays(std::size_t count, float extent) {
    std::mt19937 random(5);
    std::uniform_real_distribution<float> within(-extent, extent);
    std::normal_distribution<float> normal;
    std::vector<RayRecord> rays;
    for (std::size_t i = 0; i < count; ++i) {
        const glm::vec3 origin(within(random), within(random), within(random));
        const glm::vec3 direction(normal(random), normal(random), normal(random));
        rays.push_back(ray_from(origin, glm::normalize(direction)));
    }
    return rays;
}

class CubeMapsTest : public MappedScene {
protected:
    std::vector<HitRecord> by_maps(const CubeMaps& maps, const std::vector<RayRecord>& rays,
                                   const CubeSearchSettings& settings = {}) {
        return trace(rays, [&](const RayBatch& batch) {
            trace_cube_maps(open(), scene_, maps, settings, batch);
        });
    }

    std::vector<HitRecord> by_tree(const std::vector<RayRecord>& rays) {
        Traversal traversal = make_traversal(open(), rays.size());
        open().fill(traversal.unfinished, 0);
        return trace(rays, [&](const RayBatch& batch) {
            trace_closest(open(), scene_.bvh, traversal, batch);
        });
    }

    /// Share of the rays for which both find the same triangle at the same distance, or nothing.
    double agreement(const CubeMaps& maps, const std::vector<RayRecord>& rays,
                     const CubeSearchSettings& settings = {}) {
        const std::vector<HitRecord> found = by_maps(maps, rays, settings);
        const std::vector<HitRecord> truth = by_tree(rays);
        double same = 0;
        for (std::size_t i = 0; i < rays.size(); ++i) {
            const bool both_miss =
                found[i].triangle == no_triangle && truth[i].triangle == no_triangle;
            same +=
                both_miss || (found[i].triangle == truth[i].triangle && found[i].t == truth[i].t)
                    ? 1
                    : 0;
        }
        return same / static_cast<double>(rays.size());
    }

private:
    template <class Trace>
    std::vector<HitRecord> trace(const std::vector<RayRecord>& rays, const Trace& trace) {
        std::vector<std::uint32_t> active(rays.size());
        std::iota(active.begin(), active.end(), 0u);
        const std::vector<HitRecord> none(std::max<std::size_t>(rays.size(), 1),
                                          HitRecord{no_triangle, 0, 0, 0});
        const Buffer hits = upload(open(), "hits", none);
        trace({upload(open(), "rays", rays), upload(open(), "active", active), hits, rays.size()});
        return download<HitRecord>(open(), hits, rays.size());
    }
};

TEST_F(CubeMapsTest, RaysFromACenterHitWhatTheTreeSays) {
    load("cornell_area.glb");
    std::vector<RayRecord> rays = random_rays(10'000, 0);
    for (RayRecord& ray : rays) {
        ray.origin_x = 0.3f;
        ray.origin_y = 1.2f;
        ray.origin_z = 0.4f;
    }
    EXPECT_GE(agreement(cast({{0.3f, 1.2f, 0.4f}}, 512), rays), 0.999);
}

TEST_F(CubeMapsTest, RaysFromAnywhereMostlyDo) {
    load("cornell_area.glb");
    std::vector<RayRecord> rays = random_rays(10'000, 0.8f);
    for (RayRecord& ray : rays) {
        ray.origin_y += 1;
    }
    const CubeMaps maps = cast(
        {{0.3f, 1.2f, 0.6f}, {-0.7f, 1.6f, -0.6f}, {0.7f, 0.9f, -0.7f}, {-0.7f, 0.3f, 0.7f}}, 128);
    const double marched = agreement(maps, rays, {.march = 32});
    EXPECT_GT(marched, 0.95);
    EXPECT_LT(agreement(maps, rays, {.march = 0}), marched);
    EXPECT_LT(agreement(maps, rays, {.march = 0, .exact = false}), 0.5);
}

TEST_F(CubeMapsTest, PointsInTexelsLieNearTheHits) {
    load("closed_room.glb");
    std::vector<RayRecord> rays = random_rays(5000, 0.5f);
    for (RayRecord& ray : rays) {
        ray.origin_y += 1;
    }
    const CubeMaps maps = cast({{0.1f, 0.9f, 0.2f}}, 128);
    const std::vector<HitRecord> found =
        by_maps(maps, rays, {.march = 0, .exact = false, .tolerance = 1e-3});
    const std::vector<HitRecord> truth = by_tree(rays);
    std::vector<double> errors;
    for (std::size_t i = 0; i < rays.size(); ++i) {
        if (found[i].triangle != no_triangle && truth[i].triangle != no_triangle) {
            errors.push_back(std::abs(found[i].t - truth[i].t));
            EXPECT_GE(found[i].u, 0);
            EXPECT_GE(found[i].v, 0);
            EXPECT_LE(found[i].u + found[i].v, 1.0001f);
        }
    }
    ASSERT_GT(errors.size(), rays.size() / 2);
    std::nth_element(errors.begin(), errors.begin() + std::ptrdiff_t(errors.size() / 2),
                     errors.end());
    EXPECT_LT(errors[errors.size() / 2], 0.1);
}

TEST_F(CubeMapsTest, AnyNumberOfRaysAndAnyDirection) {
    load("cornell_glass.glb");
    const CubeMaps maps = cast({{0, 1, 0.5f}}, 33);
    EXPECT_EQ(maps.layers, most_layers);
    EXPECT_TRUE(by_maps(maps, {}).empty());
    for (const std::size_t count : {1u, 65u, 1001u}) {
        EXPECT_EQ(by_maps(maps, random_rays(count, 1)).size(), count);
    }
    std::vector<RayRecord> rays;
    for (const glm::vec3 origin : {glm::vec3(0, 1, 0.5f), glm::vec3(0), glm::vec3(1e18f, 0, 0)}) {
        for (const glm::vec3 direction :
             {glm::vec3(1, 0, 0), glm::vec3(0, -1, 0), glm::vec3(0, 0, 1), glm::vec3(0)}) {
            rays.push_back(ray_from(origin, direction));
        }
    }
    rays.push_back(ray_from({0, 1, 0}, {1, 0, 0}));
    rays.back().t_max = -1;
    const std::vector<HitRecord> hits = by_maps(maps, rays);
    EXPECT_EQ(hits.back().triangle, no_triangle);
    for (const HitRecord& hit : hits) {
        EXPECT_TRUE(hit.triangle == no_triangle || std::isfinite(hit.t));
    }
}

TEST_F(CubeMapsTest, RaysThatMissTheSceneEscape) {
    load("cornell_area.glb");
    const CubeMaps maps = cast({{0, 1, 0}}, 32);
    const std::vector<HitRecord> hits =
        by_maps(maps, {ray_from({10, 1, 0}, {0, 1, 0}), ray_from({0, 1, 5}, {0, 0, 1}),
                       ray_from({0, 1, 0.5f}, {0, 0, 1})}); // the box is open in front
    for (const HitRecord& hit : hits) {
        EXPECT_EQ(hit.triangle, no_triangle);
        EXPECT_EQ(hit.u, ray_escaped);
    }
}

TEST_F(CubeMapsTest, LayersShowWhatIsInAndBehindGlass) {
    load("cornell_glass.glb");
    std::vector<RayRecord> rays = random_rays(10'000, 0.7f);
    for (RayRecord& ray : rays) {
        ray.origin_y += 1;
    }
    const std::vector<glm::vec3> centers = {
        {0.3f, 1.7f, 0.8f}, {-0.8f, 1.6f, -0.8f}, {0.8f, 0.9f, -0.8f}, {-0.8f, 0.3f, 0.8f}};
    EXPECT_GT(agreement(cast(centers, 128), rays), 0.93);
}

/// Points on the triangles, even over their area.
std::vector<glm::vec4> points_on(const Scene& scene, std::size_t count) {
    std::vector<double> areas;
    for (const auto& t : scene.triangles) {
        areas.push_back(
            glm::length(glm::cross(glm::dvec3(scene.positions[t.y] - scene.positions[t.x]),
                                   glm::dvec3(scene.positions[t.z] - scene.positions[t.x]))));
    }
    std::mt19937 random(11);
    std::discrete_distribution<std::size_t> choose(areas.begin(), areas.end());
    std::uniform_real_distribution<float> unit(0, 1);
    std::vector<glm::vec4> points;
    for (std::size_t i = 0; i < count; ++i) {
        const auto t = scene.triangles[choose(random)];
        const float u = std::sqrt(unit(random));
        const float v = unit(random);
        points.emplace_back(scene.positions[t.x] * (1 - u) + scene.positions[t.y] * (u * (1 - v)) +
                                scene.positions[t.z] * (u * v),
                            0);
    }
    return points;
}

TEST_F(CubeMapsTest, ChosenCentersShowMoreThanRandomOnes) {
    constexpr std::uint32_t k = 8;
    for (const char* name : {"cornell_area.glb", "forty_rooms.glb", "courtyard.glb"}) {
        load(name);
        std::vector<glm::vec3> places = random_centers(scene_.box, 40, 1);
        const std::vector<glm::vec4> points = points_on(loaded_, 2000);
        const auto missing = [&](std::size_t fixed, const CenterSettings& settings) {
            return choose_centers(open(), scene_,
                                  make_cube_maps(open(), scene_, places, 32, 1, MapMaking::cast),
                                  fixed, points, settings);
        };
        const ChosenCenters chosen = missing(0, {.least = k, .most = k});
        EXPECT_LE(chosen.candidates.size(), k);
        EXPECT_LT(chosen.rounds, 16u);
        std::vector<double> random_missing;
        std::mt19937 random(7);
        for (int i = 0; i < 20; ++i) {
            std::shuffle(places.begin(), places.end(), random);
            random_missing.push_back(missing(k, {.most = k + 1, .coverage = 0}).missing);
        }
        std::sort(random_missing.begin(), random_missing.end());
        EXPECT_LE(chosen.missing, random_missing[10]) << name;
        if (std::string(name) != "cornell_area.glb") {
            EXPECT_LT(chosen.missing, random_missing[10]) << name;
        }
    }
}

TEST_F(CubeMapsTest, AFixedCenterIsChosenWhateverItShows) {
    load("cornell_area.glb");
    std::vector<glm::vec3> places = {{0.9f, 0.1f, 0.9f}, {0, 1, 0.5f}, {50, 50, 50}};
    const CubeMaps maps = make_cube_maps(open(), scene_, places, 16, 1, MapMaking::cast);
    const ChosenCenters chosen = choose_centers(open(), scene_, maps, 1, {}, {.most = 2});
    ASSERT_FALSE(chosen.candidates.empty());
    EXPECT_EQ(chosen.candidates.front(), 0u);
    EXPECT_LE(chosen.candidates.size(), 2u);
}

} // namespace
} // namespace argand::testing
