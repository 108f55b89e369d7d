#include "bench_photons.hpp"
#include "base/median.hpp"

#include "bench_nearest.hpp"
#include "cornell_scene.hpp"
#include "photon/photon_map.hpp"
#include "session/render.hpp"
#include "world/world.hpp"

namespace argand {

namespace {

double stage_seconds(Device& device, std::string_view name) {
    for (const StageTime& stage : device.stage_times()) {
        if (stage.name == name) {
            return stage.seconds;
        }
    }
    return 0;
}

} // namespace

std::vector<BenchRow> bench_photons(Device& device) {
    constexpr std::uint64_t photons = 1 << 18;
    constexpr float follow_roughness = 0.25f;
    const Scene room = cornell_scene();
    const DeviceScene scene =
        upload_scene(device, room, make_plan(room, {.follow_roughness = follow_roughness}));
    PhotonWorkspace workspace = make_photon_workspace(device, photons);
    const PhotonPass pass{.seed = 1, .first = 0, .count = photons, .bounces = 0xffff};
    const double copied = copy_rate(device);

    StoredPhotons left;
    const double traced = median_host_seconds(
        [&] { device.wait(); },
        [&] { left = trace_photons(device, scene, workspace, pass, 1e-6f).value_or(left); });
    const auto stored = static_cast<double>(left.slots);
    const double built = median_host_seconds([&] { device.wait(); },
                                             [&] {
                                                 build_photon_map(device, scene, workspace, left);
                                                 device.wait();
                                             });

    std::vector<BenchRow> rows;
    // At each bounce a photon's ray, hit, path and ledger are written and read; the record is
    // written once.
    const double bounces = 1 + stored / photons;
    const double traced_bytes = bounces * 2 * (32 + 16 + 16) + 64 + stored / photons * 32;
    rows.push_back({"photons, Cornell box", photons, traced, photons / traced, "photons/s",
                    copied / traced_bytes, "", 0});
    // Codes and order go through the four passes of the sort; records are read and written once.
    rows.push_back({"photon map", left.slots, built, stored / built, "photons/s",
                    copied / (4 * 2 * 8 + 2 * 32 + 16), "", 0});

    for (BenchRow& row : bench_nearest(device, scene, workspace, left)) {
        rows.push_back(std::move(row));
    }

    // Only the device's time stamps can time a stage of a render.
    if (!device.info().features.timestamps) {
        return rows;
    }
    RenderSettings settings;
    settings.width = 256;
    settings.height = 256;
    settings.samples = 4;
    const auto queries = std::uint64_t(settings.width) * 256 * settings.samples;
    const auto keep_going = [](double) { return true; };
    const Scene cornell = cornell_scene();
    render(device, cornell, settings, keep_going);
    std::vector<double> times;
    for (int i = 0; i < 5; ++i) {
        device.reset_stage_times();
        render(device, cornell, settings, keep_going);
        times.push_back(stage_seconds(device, "gather photons"));
    }
    const double gathered = median(times);
    rows.push_back(
        {"photon map queries", queries, gathered, queries / gathered, "queries/s", 0, "", 0});
    return rows;
}

} // namespace argand
