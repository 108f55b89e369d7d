#include "ywcyp10_tables.hpp"

#include "base/clock.hpp"
#include "base/median.hpp"
#include "session/session.hpp"
#include "world/world.hpp"

namespace argand {

namespace {

// Figure 1 (a) of the paper: 15,000 triangles, 376,000 photons, three bounces, 8 maps, 512 x 512.
constexpr std::uint32_t detail = 7;
constexpr int edge = 512;
constexpr std::uint64_t photons = 376'000;
constexpr std::uint32_t bounces = 3;

struct Way {
    const char* name;
    const char* method;
    std::map<std::string, std::string> own;
};

const Way ways[] = {
    {"tree, discs", "photons", {}},
    {"tree, footprints", "footprints", {}},
    {"maps as published, splats",
     "image-space",
     {{"maps-count", "8"}, {"march", "0"}, {"map-hits", "points"}, {"estimate", "splats"}}},
    {"maps as published, discs",
     "image-space",
     {{"maps-count", "8"}, {"march", "0"}, {"map-hits", "points"}}},
    {"maps with triangles and march, discs", "image-space", {{"maps-count", "8"}}},
};

nlohmann::ordered_json measure(Device& device, const Way& way, int runs) {
    Scene scene = make_room_of_spheres(detail);
    RenderSettings settings;
    settings.method = way.method;
    settings.width = settings.height = edge;
    settings.samples = 1;
    settings.photons = settings.photons_per_pass = photons;
    settings.bounces = bounces;
    settings.own = way.own;
    if (settings.method == "image-space") {
        settings.own["choose-every"] = "1000";
    }
    World world(device, scene);
    Session session(world, scene, settings);
    std::vector<double> seconds;
    for (int run = 0; run <= runs; ++run) { // the first compiles kernels and chooses centers
        device.reset_stage_times();
        const Clock::time_point start = Clock::now();
        session.begin_frame(static_cast<std::uint32_t>(run));
        while (const std::optional<PassPlan> plan = session.next_pass()) {
            session.step(*plan, [](double) { return true; });
        }
        device.wait();
        seconds.push_back(seconds_since(start));
    }
    nlohmann::ordered_json row{{"photons by", way.name},
                               {"first image [s]", seconds.front()},
                               {"image [s]", median({seconds.begin() + 1, seconds.end()})}};
    double tracing = 0, estimating = 0;
    for (const StageTime& stage : device.stage_times()) {
        tracing += stage.name == "trace photons" ? stage.seconds : 0;
        estimating += stage.name.find("gather") != std::string::npos ? stage.seconds : 0;
    }
    row["trace photons [s]"] = tracing;
    row["estimate [s]"] = estimating;
    const FluxSums flux = session.result().statistics.flux;
    row["lost"] = static_cast<double>(flux.lost[1]) / static_cast<double>(flux.emitted[1]);
    return row;
}

} // namespace

PaperTable bench_cube_images(Device& device, const Ywcyp10Settings& settings) {
    PaperTable table{"Images"};
    for (const Way& way : ways) {
        table.rows.push_back(measure(device, way, settings.runs));
    }
    return table;
}

} // namespace argand
