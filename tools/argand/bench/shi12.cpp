#include "shi12.hpp"

#include "base/atomic_write.hpp"
#include "base/error.hpp"
#include "base/interrupt.hpp"
#include "base/json.hpp"
#include "base/machine.hpp"
#include "scene/gltf.hpp"

#include <filesystem>
#include <fstream>

namespace argand {

namespace {

using Json = nlohmann::ordered_json;

/// Sizes of a measurement.
struct Shi12Sizes {
    std::vector<Shi12Load> construction{{5'000, 10}, {200'000, 10}};
    std::vector<Shi12Load> memory{{200'000, 10}};
    std::vector<std::uint64_t> searched{10'000,  50'000,  100'000,  150'000,
                                        200'000, 500'000, 1'000'000};
    std::vector<double> in_discs{25, 50, 100, 200, 400};
    int size = 512;      ///< of pictures that measure search
    int film_size = 512; ///< of frames
    Shi12Load film{200'000, 4};
    std::uint32_t reference_samples = 256;
};

Shi12Sizes sizes(bool quick) {
    Shi12Sizes s;
    if (quick) {
        s.construction = {{2'000, 10}};
        s.memory = {{2'000, 10}};
        s.searched = {2'000, 4'000};
        s.in_discs = {50, 200};
        s.size = s.film_size = 32;
        s.film = {4'000, 4};
        s.reference_samples = 64;
    }
    return s;
}

/// Rows that are kept in a file, so that an interrupted measurement goes on.
class KeptRows {
public:
    KeptRows(std::filesystem::path file, Json run) : file_(std::move(file)), run_(std::move(run)) {
        std::ifstream in(file_);
        const Json kept = Json::parse(in, nullptr, false);
        if (in && kept.is_object() && kept.value("run", Json()) == run_ && kept.contains("rows")) {
            rows_ = kept["rows"];
        }
    }

    /// The row of this name, measured if it is not there.
    template <class Measure> Json get(const std::string& name, const Measure& measure) {
        if (!rows_.contains(name)) {
            if (interrupted()) {
                fail("measuring '{}': interrupted; the same command goes on with this row", name);
            }
            fmt::print(stderr, "{}\n", name);
            rows_[name] = measure();
            write_json(file_, {{"run", run_}, {"rows", rows_}});
        }
        return rows_[name];
    }

private:
    std::filesystem::path file_;
    Json run_;
    Json rows_ = Json::object();
};

PaperTable table_of(const std::string& title, const Json& rows) {
    PaperTable table{title};
    table.rows = rows;
    return table;
}

std::string page(const Json& run, const std::vector<PaperTable>& tables) {
    std::string text = fmt::format(
        "# Photons that are kept from frame to frame, measured as in the thesis\n\n"
        "Written by `argand bench --paper shi12{}: what the figures of Shi 2012 show "
        "([methods/photon-queue.md](../methods/photon-queue.md)), with the parameters of its table "
        "3: three bounces, 200,000 photons, a window of 10, photons in the place of shadow rays, a "
        "sample a pixel. The scene is `dynamic_shi`. {}, {}. Times are medians of {} "
        "interleaved runs.\n\n"
        "*stored*: photons that are stored in all. *update*: a block of new photons takes the "
        "place "
        "of the oldest one, and the map is made; *leaves test*: the same where each cell tests all "
        "new photons (algorithm 1). *kd-tree*, *LBVH*: a tree over all photons, built anew. The "
        "bound is the time that a copy takes for the bytes that an update must move. Memory is "
        "that of the structure, beside the records that it is made of: *at rest*, and the most "
        "while *building*; its bound is 32 bytes a photon.\n\n",
        run["quick"].get<bool>() ? " --quick` (with fewer photons and smaller pictures)" : "`",
        run["device"].get<std::string>(), run["processor"].get<std::string>(),
        run["runs"].get<int>());
    for (const PaperTable& table : tables) {
        text += markdown_rows(table);
    }
    return text;
}

} // namespace

void bench_shi12(const OpenDevice& open, const Shi12Options& options) {
    const std::filesystem::path file = std::filesystem::path(options.scenes) / "dynamic_shi.glb";
    if (!std::filesystem::exists(file)) {
        fail("measuring '{}': there is no such file; name the folder of this project's scenes with "
             "--scenes",
             file.string());
    }
    const Scene scene = load_gltf(file, 0);
    const std::filesystem::path folder = options.folder;
    std::error_code problem;
    std::filesystem::create_directories(folder, problem);
    if (problem) {
        fail("writing results to '{}': {}; name another folder with --output", folder.string(),
             problem.message());
    }
    const Shi12Sizes s = sizes(options.quick);
    const std::unique_ptr<Device> device = open();
    const DeviceInfo& info = device->info();
    const Json run{{"build", program_fingerprint()},
                   {"backend", info.backend},
                   {"device", fmt::format("{} ({})", info.name, info.driver)},
                   {"processor", processor_name()},
                   {"runs", options.runs},
                   {"quick", options.quick}};
    KeptRows kept(folder / "shi12.json", run);
    Json construction = Json::array();
    for (const Shi12Load& load : s.construction) {
        construction.push_back(kept.get(fmt::format("construction, {} photons", load.photons), [&] {
            return measure_construction(*device, scene, load, options.runs);
        }));
    }
    Json memory = Json::array();
    for (const Shi12Load& load : s.memory) {
        memory.push_back(kept.get(fmt::format("memory, {} photons", load.photons),
                                  [&] { return measure_memory(open, scene, load); }));
    }
    Json counts = Json::array();
    for (const std::uint64_t photons : s.searched) {
        counts.push_back(kept.get(fmt::format("search, {} photons", photons), [&] {
            return measure_search(*device, scene, {photons, 10}, s.in_discs[s.in_discs.size() / 2],
                                  s.size, options.runs);
        }));
    }
    Json radii = Json::array();
    for (const double in_disc : s.in_discs) {
        radii.push_back(kept.get(fmt::format("search, {} photons in a disc", in_disc), [&] {
            return measure_search(*device, scene, s.construction.back(), in_disc, s.size,
                                  options.runs);
        }));
    }
    const Json film = kept.get("film", [&] {
        return measure_shi_film(open, scene, s.film, s.film_size, s.reference_samples);
    });
    const std::vector<PaperTable> tables{
        table_of("Figure 4.1: construction", construction),
        table_of("Figures 4.2 and 4.3: memory", memory),
        table_of("Figure 4.4: search over the number of photons", counts),
        table_of("Figure 4.5: search over the radius", radii),
        table_of("Figures 4.11 to 4.13: frames of a moving light", film)};
    write_atomically(folder / "shi12.md", page(run, tables));
    fmt::print("{}\n", (folder / "shi12.md").string());
}

} // namespace argand
