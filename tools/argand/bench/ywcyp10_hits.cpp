#include "ywcyp10_tables.hpp"

#include "base/clock.hpp"
#include "base/median.hpp"
#include "device/copy_elements.hpp"
#include "imagespace/cube_centers.hpp"
#include "photon/photon_map.hpp"
#include "scene/gltf.hpp"
#include "world/world.hpp"

#include <algorithm>
#include <filesystem>
#include <fmt/format.h>

namespace argand {

namespace {

constexpr const char* own_scenes[] = {"cornell_point", "cornell_area", "cornell_glass",
                                      "closed_room",   "courtyard",    "forty_rooms"};
constexpr std::uint32_t bounces = 3;
constexpr std::uint32_t candidates = 40;

/// How maps are made and searched.
struct Way {
    const char* name;
    std::uint32_t maps; ///< 0: as many as the scene requires
    std::uint32_t size;
    CubeSearchSettings search;
};

constexpr CubeSearchSettings published{.steps = 5, .march = 0, .exact = false, .tolerance = 1e-3};
constexpr CubeSearchSettings strict{.steps = 5, .march = 0, .exact = false, .tolerance = 1e-4};

constexpr CubeSearchSettings exact(std::uint32_t march, std::uint32_t steps = 5) {
    return {.steps = steps, .march = march, .exact = true, .tolerance = 0};
}

constexpr Way ways[] = {
    {"points, as published", 8, 128, published},
    {"points, tolerance 1e-4", 8, 128, strict},
    {"triangles", 8, 128, exact(0)},
    {"triangles, march of 8", 8, 128, exact(8)},
    {"triangles, march of 16", 8, 128, exact(16)},
    {"triangles, march of 32", 8, 128, exact(32)},
    {"triangles, march of 64", 8, 128, exact(64)},
    {"march of 32, 3 steps", 8, 128, exact(32, 3)},
    {"march of 32, 8 steps", 8, 128, exact(32, 8)},
    {"march of 32, faces of 64", 8, 64, exact(32)},
    {"march of 32, faces of 256", 8, 256, exact(32)},
    {"march of 32, faces of 512", 8, 512, exact(32)},
    {"march of 32, 4 maps", 4, 128, exact(32)},
    {"march of 32, 16 maps", 16, 128, exact(32)},
    {"march of 32, maps as required", 0, 128, exact(32)},
};

/// What became of the rays.
struct Found {
    std::uint64_t rays = 0;
    std::uint64_t equal = 0; ///< the tree's hit, or its miss
    std::uint64_t right = 0; ///< within 1 % of the scene's radius of it
    std::uint64_t wrong = 0; ///< more than 5 % of it away, or a hit where there is none
    std::uint64_t lost = 0;
};

void compare(const HitRecord& truth, const HitRecord& found, double radius, Found& sums) {
    ++sums.rays;
    const bool hits = found.triangle != no_triangle;
    if (truth.triangle == no_triangle || !hits) {
        const bool same = truth.triangle == no_triangle && !hits;
        sums.equal += same ? 1 : 0;
        sums.right += same ? 1 : 0;
        sums.lost += !same && !hits ? 1 : 0;
        sums.wrong += hits ? 1 : 0;
        return;
    }
    const double away = std::abs(double(truth.t) - double(found.t));
    sums.equal += truth.triangle == found.triangle && truth.t == found.t ? 1 : 0;
    sums.right += away <= 0.01 * radius ? 1 : 0;
    sums.wrong += away > 0.05 * radius ? 1 : 0;
}

class Bench {
public:
    Bench(Device& device, const Scene& scene, const Ywcyp10Settings& settings)
        : device_(device), settings_(settings), world_(device, scene),
          scene_(world_.on_device(scene, make_plan(scene, {.follow_roughness = 0.25f}))) {}

    /// Null if the maps do not fit into a buffer.
    nlohmann::ordered_json measure(const std::string& name, const Way& way);

private:
    Device& device_;
    const Ywcyp10Settings& settings_;
    World world_;
    DeviceScene scene_;
};

nlohmann::ordered_json Bench::measure(const std::string& name, const Way& way) {
    CenterSettings choice;
    if (way.maps > 0) {
        choice.least = choice.most = way.maps;
    }
    const Clock::time_point choosing = Clock::now();
    const std::vector<glm::vec3> places = random_centers(scene_.box, candidates, 1);
    const ChosenCenters chosen = choose_centers(
        device_, scene_, make_cube_maps(device_, scene_, places, 32, 1, MapMaking::cast), 0, {},
        choice);
    std::vector<glm::vec3> centers;
    for (const std::size_t candidate : chosen.candidates) {
        centers.push_back(places[candidate]);
    }
    const double seconds_to_choose = seconds_since(choosing);
    if (centers.size() * layers_of(scene_) * 6 * way.size * way.size > max_cube_texels(device_)) {
        return nullptr;
    }
    const Clock::time_point casting = Clock::now();
    const CubeMaps maps =
        make_cube_maps(device_, scene_, centers, way.size, layers_of(scene_), MapMaking::cast);
    const double seconds_to_cast = seconds_since(casting);
    PhotonWorkspace workspace = make_photon_workspace(device_, settings_.photons);
    const Buffer found = device_.allocate("hits in cube maps", workspace.slots * sizeof(HitRecord));
    Found sums;
    std::vector<double> tree_times;
    std::vector<double> map_times;
    for (int run = 0; run < settings_.runs; ++run) {
        double tree_seconds = 0;
        double map_seconds = 0;
        workspace.tracer = [&](const RayBatch& rays) {
            copy_elements(device_, rays.results, 0, found, 0, workspace.slots, sizeof(HitRecord));
            device_.wait();
            const Clock::time_point by_maps = Clock::now();
            trace_cube_maps(device_, scene_, maps, way.search,
                            {rays.rays, rays.active, found, rays.count});
            device_.wait();
            map_seconds += seconds_since(by_maps);
            const Clock::time_point by_tree = Clock::now();
            trace_closest(device_, scene_.bvh, workspace.traversal, rays);
            device_.wait();
            tree_seconds += seconds_since(by_tree);
            if (run > 0) {
                return;
            }
            const std::uint32_t count = download_word(device_, rays.count.buffer, rays.count.index);
            const auto active = download<std::uint32_t>(device_, rays.active, count);
            const auto truths = download<HitRecord>(device_, rays.results, workspace.slots);
            const auto hits = download<HitRecord>(device_, found, workspace.slots);
            const auto all = download<RayRecord>(device_, rays.rays, workspace.slots);
            for (const std::uint32_t i : active) {
                if (all[i].t_max >= 0) {
                    compare(truths[i], hits[i], double(scene_.record.radius), sums);
                }
            }
        };
        trace_photons(device_, scene_, workspace,
                      {.seed = 1, .first = 0, .count = settings_.photons, .bounces = bounces},
                      1e-6f);
        tree_times.push_back(tree_seconds);
        map_times.push_back(map_seconds);
    }
    const auto share = [&](std::uint64_t number) {
        return static_cast<double>(number) /
               static_cast<double>(std::max<std::uint64_t>(sums.rays, 1));
    };
    return {{"scene", name},
            {"search", way.name},
            {"maps", centers.size()},
            {"size", way.size},
            {"rays", sums.rays},
            {"equal", share(sums.equal)},
            {"right", share(sums.right)},
            {"wrong", share(sums.wrong)},
            {"lost", share(sums.lost)},
            {"choose [s]", seconds_to_choose},
            {"cast [s]", seconds_to_cast},
            {"trace [s]", median(map_times)},
            {"trace by tree [s]", median(tree_times)}};
}

} // namespace

PaperTable bench_cube_hits(Device& device, const Ywcyp10Settings& settings) {
    PaperTable table{"Hits in cube maps"};
    for (const std::string& file : scene_files(settings.scenes, own_scenes)) {
        const Scene scene = load_gltf(file);
        Bench bench(device, scene, settings);
        for (const Way& way : ways) {
            const nlohmann::ordered_json row =
                bench.measure(std::filesystem::path(file).stem().string(), way);
            if (!row.is_null()) {
                table.rows.push_back(row);
            }
        }
    }
    return table;
}

} // namespace argand
