#include "base/clock.hpp"
#include "base/error.hpp"
#include "base/median.hpp"
#include "bench.hpp"
#include "methods/eye_paths.hpp"
#include "methods/plan_render.hpp"
#include "photon/gather.hpp"
#include "photon/queue_kdtree.hpp"
#include "photon/queue_map.hpp"
#include "photon/triangle_planes.hpp"
#include "shared/photon.h"
#include "shi12.hpp"
#include "world/world.hpp"

#include <array>
#include <cmath>
#include <numbers>

namespace argand {

namespace {

constexpr std::uint32_t leaf_size = 16;
constexpr std::uint32_t bounces = 3;
constexpr std::uint64_t photons_of_table_3 = 200'000;
constexpr double mib = 1 << 20;

RenderSettings settings_of(const Shi12Load& load, int size) {
    RenderSettings settings;
    settings.method = "photon-queue";
    settings.own["direct"] = "photons";
    settings.width = settings.height = size;
    settings.samples = 1;
    settings.bounces = bounces;
    settings.photons = load.photons;
    return settings;
}

/// Stored photons, block after block.
struct Blocks {
    std::vector<PhotonRecord> photons;
    std::vector<std::uint64_t> first; ///< of each block, and the end
    std::uint64_t size(std::size_t block) const { return first[block + 1] - first[block]; }
};

Blocks trace_blocks(Device& device, const Scene& scene, const Shi12Load& load) {
    const DeviceScene on_device =
        upload_scene(device, scene, plan_render(scene, settings_of(load, 64)));
    PhotonWorkspace workspace = make_photon_workspace(device, load.photons / load.window + 1);
    Blocks blocks{.photons = {}, .first = {0}};
    for (std::uint32_t b = 0; b < load.window; ++b) {
        const std::uint64_t first = load.photons * b / load.window;
        const PhotonPass pass{.first = first,
                              .count = load.photons * (b + 1) / load.window - first,
                              .bounces = bounces,
                              .first_hits = true};
        const std::optional<StoredPhotons> stored =
            trace_photons(device, on_device, workspace, pass, 1e-6f);
        if (!stored) {
            fail("measuring '{}': '{}' cannot hold {} photons", scene.name, device.info().name,
                 pass.count);
        }
        for (const PhotonRecord& p :
             download<PhotonRecord>(device, workspace.photons, stored->slots)) {
            if (p.normal != no_photon) {
                blocks.photons.push_back(p);
            }
        }
        blocks.first.push_back(blocks.photons.size());
    }
    if (blocks.photons.size() > max_stored_photons(device)) {
        fail("measuring '{}': {} photons are stored, more than '{}' can address", scene.name,
             blocks.photons.size(), device.info().name);
    }
    return blocks;
}

/// Memory of photons that are there already, without that of tracing.
PhotonWorkspace workspace_of(Device& device, const std::vector<PhotonRecord>& photons) {
    PhotonWorkspace w;
    w.capacity = std::max<std::uint64_t>(photons.size(), 1);
    w.photons = upload(device, "photons", photons);
    w.offsets = device.allocate("photon differentials, stored", 16);
    w.codes = device.allocate("photon codes", w.capacity * 4);
    w.order = device.allocate("photon order", w.capacity * 4);
    w.heads = device.allocate("photon map heads", w.capacity * 4);
    w.counters = device.allocate("photon counters", counter_count * 4);
    device.fill(w.counters, 0);
    upload_word(device, w.counters, counter_stored_slots,
                static_cast<std::uint32_t>(photons.size()));
    return w;
}

/// The structures over the photons of a load.
class Structures {
public:
    Structures(Device& device, const Scene& scene, const Blocks& blocks, double reach)
        : device_(device), blocks_(blocks), reach_(reach),
          planes_(triangle_planes(scene, double(blocks.photons.size()) / leaf_size)) {
        empty_.record.radius = 1;
        empty_.scene = upload(device, "scene", std::vector<SceneRecord>{empty_.record});
    }

    void store() { workspace_ = workspace_of(device_, blocks_.photons); }

    /// Fills the queue, a block in each frame.
    void fill(bool leaves_test) {
        const auto window = static_cast<std::uint32_t>(blocks_.first.size() - 1);
        queue_ = make_photon_queue(window, leaf_size);
        queue_.leaves_test = leaves_test;
        divide_queue(device_, queue_, planes_, records(0), window, false);
        for (std::uint32_t b = 0; b < window; ++b) {
            add(b);
        }
        if (is_crowded(queue_)) {
            divide_queue_anew(device_, queue_, planes_);
        }
    }

    void add(std::uint32_t block) {
        replace_block(device_, queue_, block, ++moment_, records(block));
        queue_.blocks[block].weight = 1.0f / static_cast<float>(queue_.window);
    }
    void set_leaves_test(bool leaves_test) { queue_.leaves_test = leaves_test; }

    PhotonMap queue_map() { return map_of_queue(device_, queue_, {}); }

    PhotonMap kdtree_map() {
        PhotonQueue sorted =
            sort_by_kdtree(device_, workspace_, blocks_.photons.size(), reach_, leaf_size, false);
        return map_of_queue(device_, sorted, {});
    }

    PhotonMap lbvh_map() {
        const std::uint64_t n = blocks_.photons.size();
        return build_photon_map(device_, empty_, workspace_, {.slots = n, .photons = n});
    }

    /// Seconds of work on the device, by the clock.
    template <class Work> double timed(const Work& work) {
        device_.wait();
        const Clock::time_point begin = Clock::now();
        work();
        device_.wait();
        return seconds_since(begin);
    }

private:
    QueueRecords records(std::size_t block) const {
        return {workspace_.photons, blocks_.first[block], blocks_.size(block), blocks_.size(block)};
    }

    Device& device_;
    const Blocks& blocks_;
    double reach_;
    std::vector<CellNode> planes_;
    DeviceScene empty_;
    PhotonWorkspace workspace_;
    PhotonQueue queue_;
    std::uint32_t moment_ = 0;
};

/// The radius in which so many photons would lie on average if those of table 3 were emitted.
double radius_of(Device& device, const Scene& scene, double in_disc) {
    const DeviceScene on_device = upload_scene(
        device, scene, plan_render(scene, settings_of({.photons = photons_of_table_3}, 64)));
    constexpr double stored_each = 3; // about, of the photons of this scene
    return std::sqrt(in_disc * on_device.surface_area /
                     (std::numbers::pi * stored_each * double(photons_of_table_3)));
}

constexpr double usual_in_disc = 100;

} // namespace

nlohmann::ordered_json measure_construction(Device& device, const Scene& scene,
                                            const Shi12Load& load, int runs) {
    const Blocks blocks = trace_blocks(device, scene, load);
    Structures of(device, scene, blocks, radius_of(device, scene, usual_in_disc));
    of.store();
    of.fill(true); // with what cells need to test photons
    std::array<std::vector<double>, 4> seconds;
    for (int run = 0; run <= runs; ++run) {
        const auto block = static_cast<std::uint32_t>(run) % load.window;
        std::array<double, 4> now{};
        for (const bool leaves_test : {false, true}) {
            of.set_leaves_test(leaves_test);
            now[leaves_test ? 1 : 0] = of.timed([&] {
                of.add(block);
                of.queue_map();
            });
        }
        now[2] = of.timed([&] { of.kdtree_map(); });
        now[3] = of.timed([&] { of.lbvh_map(); });
        for (std::size_t i = 0; i < now.size() && run > 0; ++i) { // the first run warms up
            seconds[i].push_back(now[i]);
        }
    }
    const double update = median(seconds[0]);
    const auto stored = static_cast<double>(blocks.photons.size());
    // New photons are read and written, entries and their cells too, and the map reads the photons
    // and writes them.
    const double bytes = 64 * stored / load.window + 16 * stored + 64 * stored;
    return {{"photons", load.photons},
            {"a frame", load.photons / load.window},
            {"stored", blocks.photons.size()},
            {"update [ms]", 1e3 * update},
            {"leaves test [ms]", 1e3 * median(seconds[1])},
            {"kd-tree [ms]", 1e3 * median(seconds[2])},
            {"LBVH [ms]", 1e3 * median(seconds[3])},
            {"kd-tree / update", median(seconds[2]) / update},
            {"LBVH / update", median(seconds[3]) / update},
            {"bytes bound [ms]", 1e3 * bytes / copy_rate(device)}};
}

nlohmann::ordered_json measure_memory(const OpenDevice& open, const Scene& scene,
                                      const Shi12Load& load) {
    const Blocks blocks = [&] {
        const std::unique_ptr<Device> device = open();
        return trace_blocks(*device, scene, load);
    }();
    const auto stored = static_cast<double>(blocks.photons.size());
    nlohmann::ordered_json row{{"photons", load.photons},
                               {"stored", blocks.photons.size()},
                               {"bound [MiB]", 32 * stored / mib}};
    const auto measure = [&](const std::string& name, const auto& make) {
        const std::unique_ptr<Device> device = open();
        std::optional<Structures> of(std::in_place, *device, scene, blocks, 0.1);
        const std::uint64_t start = device->memory().current;
        of->store();
        const std::uint64_t records = device->memory().current - start;
        PhotonMap map = make(*of);
        device->wait();
        const std::uint64_t whole = device->memory().current;
        const std::uint64_t peak = device->memory().peak - start - records;
        map = PhotonMap();
        of.reset();
        device->wait(); // until then, commands may hold memory
        // What is left is scratch memory, which the device keeps for whoever wants it next.
        row[name + ": at rest [MiB]"] = double(whole - device->memory().current - records) / mib;
        row[name + ": building [MiB]"] = double(peak) / mib;
    };
    measure("queue", [](Structures& of) {
        of.fill(false);
        return of.queue_map();
    });
    measure("kd-tree", [](Structures& of) { return of.kdtree_map(); });
    measure("LBVH", [](Structures& of) { return of.lbvh_map(); });
    return row;
}

nlohmann::ordered_json measure_search(Device& device, const Scene& scene, const Shi12Load& load,
                                      double in_disc, int size, int runs) {
    const Blocks blocks = trace_blocks(device, scene, load);
    const double radius = radius_of(device, scene, in_disc);
    Structures of(device, scene, blocks, radius);
    of.store();
    of.fill(false);
    const std::array<PhotonMap, 3> maps{of.queue_map(), of.kdtree_map(), of.lbvh_map()};
    const RenderSettings settings = settings_of(load, size);
    const DeviceScene on_device = upload_scene(device, scene, plan_render(scene, settings));
    EyeWorkspace eye = make_eye_workspace(device, on_device.plan, settings,
                                          camera_record(scene.cameras[0], size, size));
    // Equation 14: all photons of a ball count the same.
    RadiusEstimator estimator(device, on_device.plan, {radius, radius}, gather_budget,
                              {.uniform_kernel = true, .ball = true});
    std::array<std::vector<double>, 3> seconds;
    for (int run = 0; run <= runs; ++run) {
        for (std::size_t i = 0; i < maps.size(); ++i) {
            const PhotonLookup lookup{.map = maps[i], .estimator = estimator};
            device.reset_stage_times();
            trace_eye_paths(device, on_device, eye, {.samples = 1, .bounces = bounces}, &lookup,
                            [](double) { return true; });
            for (const StageTime& stage : device.stage_times()) {
                if (run > 0 && stage.name == "gather photons") { // the first run warms up
                    seconds[i].push_back(stage.seconds);
                }
            }
        }
    }
    const double queue = median(seconds[0]);
    return {{"photons", load.photons},
            {"stored", blocks.photons.size()},
            {"radius", radius},
            {"in a disc", in_disc * double(load.photons) / double(photons_of_table_3)},
            {"queue [ms]", 1e3 * queue},
            {"kd-tree [ms]", 1e3 * median(seconds[1])},
            {"LBVH [ms]", 1e3 * median(seconds[2])},
            {"queue / kd-tree", queue / median(seconds[1])},
            {"queue / LBVH", queue / median(seconds[2])}};
}

} // namespace argand
