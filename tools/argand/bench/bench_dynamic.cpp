#include "bench_dynamic.hpp"

#include "base/atomic_write.hpp"
#include "base/error.hpp"
#include "base/fingerprint.hpp"
#include "base/interrupt.hpp"
#include "base/json.hpp"
#include "base/machine.hpp"
#include "base/progress.hpp"
#include "base/read_file.hpp"
#include "methods/method_info.hpp"

#include <algorithm>
#include <fstream>
#include <map>
#include <numeric>
#include <set>

namespace argand {

namespace {

using Json = nlohmann::ordered_json;

/// Sizes of a measurement.
struct DynamicSizes {
    int side = 128; ///< of the pictures, in pixels
    std::uint32_t samples = 8;
    /// Few, for each reference is two images, whose noise cancels out of squared errors.
    std::uint32_t reference_samples = 256;
    std::uint64_t photons = 200'000;
    std::vector<std::uint32_t> seeds{1, 2, 3, 4};
};

DynamicSizes sizes(bool quick) {
    return quick ? DynamicSizes{.side = 48,
                                .samples = 4,
                                .reference_samples = 256,
                                .photons = 20'000,
                                .seeds = {1, 2}}
                 : DynamicSizes();
}

/// A method with options of its own.
struct Measured {
    std::string name; ///< of the rows
    std::string method;
    std::map<std::string, std::string> own;
};

/// What is measured: every method, and photons queues of several windows and with trees that are
/// built anew for each frame.
std::vector<Measured> measured_by(MethodTable methods) {
    std::vector<Measured> all;
    for (const MethodInfo& method : methods) {
        if (!method.abilities.keeps_photons) {
            all.push_back({method.name, method.name, {}});
            continue;
        }
        for (const char* window : {"1", "4", "10", "64"}) {
            all.push_back(
                {fmt::format("{} W={}", method.name, window), method.name, {{"window", window}}});
        }
        for (const char* tree : {"kdtree", "lbvh"}) {
            all.push_back({fmt::format("{} rebuild={}", method.name, tree),
                           method.name,
                           {{"rebuild", tree}}});
        }
    }
    return all;
}

Json names_of(const std::vector<Measured>& all) {
    Json names = Json::array();
    for (const Measured& measured : all) {
        names.push_back(measured.name);
    }
    return names;
}

std::string contents_of(const std::filesystem::path& file) {
    const std::vector<std::uint8_t> bytes = read_file(file);
    return fmt::format("{:016x}", fingerprint(std::as_bytes(std::span(bytes))));
}

/// What the results of a film depend on.
Json run_of(const DynamicScene& film, const DynamicSizes& sizes, const DeviceInfo& device,
            MethodTable methods) {
    return {{"film", film.name},
            {"contents", contents_of(film.file)},
            {"fps", film.fps},
            {"frames", film.frames},
            {"side", sizes.side},
            {"samples", sizes.samples},
            {"photons", sizes.photons},
            {"reference_samples", sizes.reference_samples},
            {"seeds", sizes.seeds},
            {"methods", names_of(measured_by(methods))},
            {"build", program_fingerprint()},
            {"backend", device.backend},
            {"device", device.name},
            {"driver", device.driver}};
}

Json to_json(const std::string& film, const std::string& method, const MeasuredFrame& frame) {
    Json row{{"film", film},
             {"method", method},
             {"frame", frame.frame},
             {"seconds", frame.seconds},
             {"update_seconds", frame.update_seconds},
             {"peak_bytes", frame.peak_bytes},
             {"photons_emitted", frame.photons_emitted},
             {"photons_stored", frame.photons_stored},
             {"rel_mse", Json()},
             {"squared_bias", Json()},
             {"variance", Json()},
             {"flicker", Json()},
             {"lag", Json()}};
    if (frame.errors) {
        row["rel_mse"] = frame.errors->rel_mse;
        row["squared_bias"] = frame.errors->squared_bias;
        row["variance"] = frame.errors->variance;
        row["lag"] = frame.errors->lag;
        if (frame.errors->flicker) {
            row["flicker"] = *frame.errors->flicker;
        }
    }
    for (const auto& [stage, seconds] : frame.stage_seconds) {
        row["stage: " + stage] = seconds;
    }
    return row;
}

/// The rows of a film that was measured by the same run; nothing if there is none.
std::optional<Json> read_rows(const std::filesystem::path& file, const Json& run) {
    std::ifstream in(file);
    const Json kept = Json::parse(in, nullptr, false);
    if (!in || kept.is_discarded() || !kept.is_object() || kept.value("run", Json()) != run ||
        !kept.contains("rows")) {
        return std::nullopt;
    }
    return kept["rows"];
}

std::string csv_of(const Json& rows) {
    std::vector<std::string> columns;
    for (const Json& row : rows) {
        for (const auto& [name, value] : row.items()) {
            if (std::find(columns.begin(), columns.end(), name) == columns.end()) {
                columns.push_back(name);
            }
        }
    }
    std::string text = fmt::format("{}\n", fmt::join(columns, ","));
    for (const Json& row : rows) {
        std::vector<std::string> cells;
        cells.reserve(columns.size());
        for (const std::string& column : columns) {
            const Json value = row.value(column, Json());
            cells.push_back(value.is_null()     ? ""
                            : value.is_string() ? value.get<std::string>()
                                                : value.dump());
        }
        text += fmt::format("{}\n", fmt::join(cells, ","));
    }
    return text;
}

[[noreturn]] void fail_interrupted(const DynamicScene& film) {
    fail("measuring '{}': interrupted; the same command goes on with this film", film.name);
}

RenderSettings settings_of(const DynamicSizes& sizes) {
    RenderSettings settings;
    settings.width = settings.height = sizes.side;
    settings.samples = sizes.samples;
    settings.photons = sizes.photons;
    return settings;
}

FilmReferences references_of(const OpenDevice& open, const DynamicScene& film,
                             const DynamicSizes& sizes, const std::filesystem::path& folder,
                             MethodTable methods) {
    Progress progress("references of " + film.name);
    progress.update(0);
    std::optional<FilmReferences> references = film_references(
        open, film, settings_of(sizes), sizes.reference_samples, folder / "references",
        [] { return !interrupted(); }, methods);
    if (!references) {
        fail_interrupted(film);
    }
    return std::move(*references);
}

Json measure(const OpenDevice& open, const DynamicScene& film, const DynamicSizes& sizes,
             const FilmReferences& references, MethodTable methods) {
    RenderSettings settings = settings_of(sizes);
    Json rows = Json::array();
    for (const auto& [name, method, own] : measured_by(methods)) {
        Progress progress(film.name + " by " + name);
        progress.update(0);
        settings.method = method;
        settings.own = own;
        const auto frames = measure_film(
            open, film, settings, sizes.seeds, references, [] { return !interrupted(); }, methods);
        if (!frames) {
            fail_interrupted(film);
        }
        for (const MeasuredFrame& frame : *frames) {
            rows.push_back(to_json(film.name, name, frame));
        }
    }
    return rows;
}

/// Frames 0 to `end` - 1.
std::vector<std::uint64_t> all_frames(std::uint64_t end) {
    std::vector<std::uint64_t> frames(end);
    std::iota(frames.begin(), frames.end(), 0);
    return frames;
}

/// So many pairs of successive frames, for flicker, evenly over a film; all of a short film.
std::vector<std::uint64_t> frames_with_references(std::uint64_t frames, std::uint64_t pairs) {
    if (frames <= 2 * pairs) {
        return all_frames(frames);
    }
    std::vector<std::uint64_t> chosen;
    for (std::uint64_t pair = 0; pair < pairs; ++pair) {
        const std::uint64_t second = (pair + 1) * frames / pairs - 1;
        chosen.push_back(second - 1);
        chosen.push_back(second);
    }
    return chosen;
}

/// A film, and how many times as many samples its references need as those of others.
struct BenchFilm {
    DynamicScene scene;
    std::uint32_t reference_factor = 1;
};

/// The films of the benchmark, in a folder.
std::vector<BenchFilm> bench_films(const std::string& folder, bool quick) {
    std::vector<BenchFilm> films;
    const auto add = [&](const char* name, std::uint64_t frames, std::uint32_t factor = 1) {
        films.push_back(
            {.scene = {.name = name,
                       .file = std::filesystem::path(folder) / (std::string(name) + ".glb"),
                       .frames = frames,
                       .references = frames_with_references(frames, quick ? 2 : 4)},
             .reference_factor = factor});
    };
    add("cornell_glass", quick ? 2 : 8); // nothing moves
    add("dynamic_shi", 7);
    add("dynamic_slow_light", quick ? 8 : 64);
    add("dynamic_switch", 12);
    add("dynamic_block", quick ? 8 : 16);
    // Paths find caustics by chance.
    add("dynamic_occluder", quick ? 8 : 16, 4);
    add("dynamic_water", quick ? 8 : 16, quick ? 16 : 4);
    add("dynamic_camera", quick ? 8 : 16);
    return films;
}

} // namespace

void bench_dynamic(const OpenDevice& open, const DynamicOptions& options, MethodTable methods) {
    std::vector<BenchFilm> films = bench_films(options.scenes, options.quick);
    for (const std::string& name : options.films) {
        if (std::none_of(films.begin(), films.end(),
                         [&](const BenchFilm& film) { return film.scene.name == name; })) {
            throw UsageError(fmt::format("measuring '{}': there is no such film", name));
        }
    }
    if (!options.films.empty()) {
        std::erase_if(films, [&](const BenchFilm& film) {
            return std::find(options.films.begin(), options.films.end(), film.scene.name) ==
                   options.films.end();
        });
    }
    for (const BenchFilm& bench_film : films) {
        const DynamicScene& film = bench_film.scene;
        if (!std::filesystem::exists(film.file)) {
            fail("measuring '{}': there is no file '{}'; name the folder of this project's scenes "
                 "with --scenes",
                 film.name, film.file.string());
        }
    }
    const std::filesystem::path folder = options.folder;
    std::filesystem::create_directories(folder / "references");
    const DeviceInfo device = open()->info();
    const auto sizes_of = [&](const BenchFilm& film) {
        DynamicSizes of_film = sizes(options.quick);
        of_film.reference_samples *= film.reference_factor;
        return of_film;
    };
    // All references come first: they take the longest, and no film is measured twice for them.
    std::map<std::string, FilmReferences> references;
    for (const BenchFilm& film : films) {
        references[film.scene.name] =
            references_of(open, film.scene, sizes_of(film), folder, methods);
    }
    Json all = Json::array();
    for (const BenchFilm& bench_film : films) {
        const DynamicScene& film = bench_film.scene;
        const DynamicSizes of_run = sizes_of(bench_film);
        const std::filesystem::path file = folder / (film.name + ".json");
        const Json run = run_of(film, of_run, device, methods);
        std::optional<Json> rows = read_rows(file, run);
        if (!rows) {
            rows = measure(open, film, of_run, references.at(film.name), methods);
            write_json(file, {{"run", run}, {"rows", *rows}});
        }
        all.insert(all.end(), rows->begin(), rows->end());
        write_atomically(folder / "dynamic.csv", csv_of(all));
    }
    fmt::print("{}: {} frames of {} films\n", (folder / "dynamic.csv").string(), all.size(),
               films.size());
}

} // namespace argand
