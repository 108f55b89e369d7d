#include "kdgs10.hpp"

#include "base/clock.hpp"
#include "base/median.hpp"
#include "bench.hpp"
#include "bench_queries.hpp"
#include "photon/frontier.hpp"
#include "photon/gather.hpp"
#include "shared/photon.h"
#include "world/world.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <numbers>
#include <random>

namespace argand {

namespace {

constexpr double photons_a_query = 50;
constexpr double far_share = 0.01; ///< of the walls' area, on which far queries lie
constexpr int walls = 6;

struct Load {
    std::uint64_t queries, photons;
    bool coherent; ///< queries come row by row
    bool near;     ///< on all walls
};

struct Point {
    glm::vec3 place, normal;
};

/// A point of a wall of the unit cube, whose normal is towards the middle.
Point on_wall(int wall, float u, float v) {
    const int axis = wall % 3;
    const auto side = static_cast<float>(wall / 3);
    Point point{};
    point.place[axis] = side;
    point.place[(axis + 1) % 3] = u;
    point.place[(axis + 2) % 3] = v;
    point.normal[axis] = 1 - 2 * side;
    return point;
}

std::vector<Point> query_points(const Load& load) {
    std::mt19937 random(7);
    std::uniform_real_distribution<float> anywhere(0, 1);
    const int used = load.near ? walls : 1;
    const auto edge = static_cast<float>(load.near ? 1 : std::sqrt(far_share * walls));
    const auto rows =
        static_cast<std::uint64_t>(std::ceil(std::sqrt(static_cast<double>(load.queries) / used)));
    std::vector<Point> points;
    points.reserve(load.queries);
    for (std::uint64_t i = 0; i < load.queries; ++i) {
        if (load.coherent) {
            const std::uint64_t at = i % (rows * rows);
            const auto wall = static_cast<int>(i / (rows * rows));
            points.push_back(on_wall(wall, edge * (float(at % rows) + 0.5f) / float(rows),
                                     edge * (float(at / rows) + 0.5f) / float(rows)));
        } else {
            const float u = edge * anywhere(random);
            const float v = edge * anywhere(random);
            points.push_back(on_wall(static_cast<int>(random() % used), u, v));
        }
    }
    return points;
}

std::vector<PhotonRecord> photon_records(std::uint64_t count) {
    std::mt19937 random(11);
    std::uniform_real_distribution<float> anywhere(0, 1);
    std::vector<PhotonRecord> photons;
    photons.reserve(count);
    for (std::uint64_t i = 0; i < count; ++i) {
        const float u = anywhere(random);
        const float v = anywhere(random);
        const Point p = on_wall(static_cast<int>(random() % walls), u, v);
        photons.push_back({.x = p.place.x,
                           .y = p.place.y,
                           .z = p.place.z,
                           .normal = pack_photon_normal(p.normal, false),
                           .flux_r = 1,
                           .flux_g = 1,
                           .flux_b = 1,
                           .direction = pack_photon_direction(p.normal, 1, 0)});
    }
    return photons;
}

/// Seconds of the two ways, each with its map: medians of interleaved runs.
struct Times {
    double build = 0, answer = 0;         ///< with a tree
    double list = 0, answer_together = 0; ///< without
    double tree() const { return build + answer; }
    double together() const { return list + answer_together; }
};

double radius_for(const Load& load) {
    return std::sqrt(photons_a_query * walls / (std::numbers::pi * double(load.photons)));
}

class Bench {
public:
    Bench(Device& device, const Kdgs10Settings& settings)
        : device_(device), settings_(settings), copied_(copy_rate(device)),
          scene_(empty_scene(device)), compared_(compare_rate()) {}

    nlohmann::ordered_json measure(const Load& load);

private:
    static DeviceScene empty_scene(Device& device);
    void store(std::uint64_t photons);
    PhotonQueries upload_queries(const Load& load);
    double compare_rate();
    double timed_map(const std::optional<FrontierSettings>& together, PhotonMap& map);
    double timed_answers(const PhotonMap& map, const PhotonQueries& queries, double radius);
    double useful_pairs(const PhotonMap& map, const PhotonQueries& queries, double radius);

    Device& device_;
    Kdgs10Settings settings_;
    double copied_; ///< bytes per second
    DeviceScene scene_;
    PhotonWorkspace workspace_;
    StoredPhotons stored_;
    double compared_; ///< pairs of a query and a photon per second
};

DeviceScene Bench::empty_scene(Device& device) {
    DeviceScene scene;
    scene.record.radius = 1;
    scene.scene = upload(device, "scene", std::vector<SceneRecord>{scene.record});
    return scene;
}

/// Stores so many photons, if they are not stored already.
void Bench::store(std::uint64_t count) {
    if (stored_.photons == count) {
        return;
    }
    const std::vector<PhotonRecord> photons = photon_records(count);
    workspace_ = PhotonWorkspace();
    workspace_ = make_photon_workspace(device_, (photons.size() + 2) / 3);
    device_.upload(workspace_.photons, 0, std::as_bytes(std::span(photons)));
    upload_word(device_, workspace_.counters, counter_stored_slots,
                static_cast<std::uint32_t>(photons.size()));
    stored_ = {photons.size(), photons.size(), photons.size()};
}

PhotonQueries Bench::upload_queries(const Load& load) {
    std::vector<QueryRecord> records;
    records.reserve(load.queries);
    for (const Point& point : query_points(load)) {
        records.push_back(bench_query(point.place, point.normal));
    }
    return bench_queries(device_, records);
}

double Bench::timed_map(const std::optional<FrontierSettings>& together, PhotonMap& map) {
    map = PhotonMap();
    device_.wait();
    const Clock::time_point begin = Clock::now();
    PhotonMapSettings settings;
    settings.frontier = together;
    map = build_photon_map(device_, scene_, workspace_, stored_, settings);
    device_.wait();
    return seconds_since(begin);
}

double Bench::timed_answers(const PhotonMap& map, const PhotonQueries& queries, double radius) {
    RadiusEstimator estimator(device_, scene_.plan, {radius, radius});
    const Clock::time_point begin = Clock::now();
    estimator.estimate(map, queries);
    device_.wait();
    return seconds_since(begin);
}

/// Pairs per second of a search that is one leaf, which compares each query with each photon. In
/// few of these pairs the photon counts, so that a pair costs the least that it can.
double Bench::compare_rate() {
    const Load load{.queries = 256, .photons = 1 << 16, .coherent = false, .near = true};
    store(load.photons);
    const PhotonQueries queries = upload_queries(load);
    PhotonMap list;
    timed_map(FrontierSettings{.query_leaf = 1 << 20}, list);
    const double radius = radius_for(load);
    timed_answers(list, queries, radius); // the first run warms up
    return static_cast<double>(load.queries * load.photons) / timed_answers(list, queries, radius);
}

/// Pairs of a query and a photon within the radius, from estimates in which each counts the same.
double Bench::useful_pairs(const PhotonMap& map, const PhotonQueries& queries, double radius) {
    RadiusEstimator estimator(device_, scene_.plan, {radius, radius}, gather_budget,
                              {.uniform_kernel = true, .ball = true});
    estimator.estimate(map, queries);
    const double each = bench_reflectance / (std::numbers::pi * radius * radius);
    double pairs = 0;
    for (const EstimateRecord& e :
         download<EstimateRecord>(device_, queries.estimates, queries.count.bound)) {
        pairs += e.indirect_r / each;
    }
    return pairs;
}

nlohmann::ordered_json Bench::measure(const Load& load) {
    store(load.photons);
    const PhotonQueries queries = upload_queries(load);
    const double radius = radius_for(load);
    std::array<std::vector<double>, 4> seconds;
    PhotonMap tree;
    PhotonMap list;
    for (int run = 0; run <= settings_.runs; ++run) {
        const std::array<double, 4> now = {
            timed_map({}, tree), timed_answers(tree, queries, radius),
            timed_map(FrontierSettings(), list), timed_answers(list, queries, radius)};
        for (std::size_t i = 0; i < now.size() && run > 0; ++i) { // the first run warms up
            seconds[i].push_back(now[i]);
        }
    }
    const Times times{median(seconds[0]), median(seconds[1]), median(seconds[2]),
                      median(seconds[3])};
    const double useful = useful_pairs(tree, queries, radius);
    FrontierStatistics statistics;
    std::uint64_t bytes = 0;
    search_simultaneously(
        device_, list, queries, radius, {},
        [&](const FrontierLeaves&) {
            bytes = std::max(bytes, device_.memory_by_name().at("simultaneous search").current);
        },
        &statistics);
    // A reference is read to count it, and read to copy it; its copies are written. Photons are
    // read once. What leaves read is not counted.
    const double moved = 16.0 * (3.0 * double(statistics.references) -
                                 double(statistics.discarded) + double(statistics.replicated)) +
                         32.0 * double(load.photons);
    const auto photons = static_cast<double>(load.photons);
    const auto references = static_cast<double>(std::max<std::uint64_t>(statistics.references, 1));
    return {{"queries", load.queries},
            {"photons", load.photons},
            {"order", load.coherent ? "rows" : "scattered"},
            {"where", load.near ? "near" : "far"},
            {"tree: build s", times.build},
            {"tree: answer s", times.answer},
            {"together: list s", times.list},
            {"together: answer s", times.answer_together},
            {"speedup", times.tree() / times.together()},
            {"box tests a photon", double(statistics.box_tests) / photons},
            {"entered", double(statistics.entered) / photons},
            {"discarded", double(statistics.discarded) / references},
            {"replicated", double(statistics.replicated) / references},
            {"pairs over useful", double(statistics.pairs) / std::max(useful, 1.0)},
            {"pairs/s", double(statistics.pairs) / times.answer_together},
            {"levels", statistics.levels},
            {"MiB", double(bytes) / (1 << 20)},
            {"bytes bound s", moved / copied_},
            {"pairs bound s", double(statistics.pairs) / compared_}};
}

} // namespace

PaperTable bench_kdgs10(Device& device, const Kdgs10Settings& settings) {
    PaperTable table{"Simultaneous queries against a tree over the photons"};
    Bench bench(device, settings);
    for (std::uint64_t photons = 10'000; photons <= settings.most_photons; photons *= 10) {
        // A workspace has room for three photons for each one that is emitted.
        const std::uint64_t stored = std::min(photons, max_stored_photons(device) / 3 * 3);
        for (std::uint64_t queries = 1'000; queries <= settings.most_queries; queries *= 10) {
            for (const bool near : {true, false}) {
                for (const bool coherent : {true, false}) {
                    table.rows.push_back(bench.measure({queries, stored, coherent, near}));
                }
            }
        }
        if (stored < photons) {
            break;
        }
    }
    return table;
}

} // namespace argand
