#include "sweep/tradeoff.hpp"

#include "base/atomic_write.hpp"
#include "base/error.hpp"
#include "base/fingerprint.hpp"
#include "base/json.hpp"
#include "base/read_file.hpp"
#include "base/text.hpp"
#include "image/exr.hpp"
#include "methods/method_info.hpp"
#include "methods/plan_render.hpp"
#include "sweep/parameters.hpp"

#include <algorithm>
#include <array>
#include <fmt/ranges.h>
#include <new>
#include <numeric>
#include <set>

namespace argand {

namespace fs = std::filesystem;

namespace {

constexpr std::array<std::uint32_t, 1> pilot_seed{0x40000000u}; // settings use other seeds

fs::path results_file(const fs::path& folder) { return folder / "tradeoff.json"; }

void make_folder(const fs::path& folder) {
    std::error_code failed;
    fs::create_directories(folder, failed);
    if (failed) {
        fail("making the folder '{}': {}; choose another one", folder.string(), failed.message());
    }
}

nlohmann::ordered_json run_of(const TradeoffRequest& request) {
    nlohmann::ordered_json run = request.run;
    run["width"] = request.base.width;
    run["height"] = request.base.height;
    run["camera"] = request.base.camera;
    run["seeds"] = request.seeds;
    for (const fs::path& file : request.reference_files) {
        const std::vector<std::uint8_t> bytes = read_file(file);
        run["references"].push_back(
            fmt::format("{:016x}", fingerprint(std::as_bytes(std::span(bytes)))));
    }
    return run;
}

void save(const fs::path& folder, const Results& results) {
    write_atomically(folder / "tradeoff.csv", to_csv(results));
    write_json(results_file(folder), to_json(results));
}

/// Turns std::bad_alloc into Error, so that the host running out of memory is handled as the device
/// running out of memory.
RenderTrials without_bad_alloc(const RenderTrials& render, MethodTable methods) {
    return
        [&render, methods](const RenderSettings& settings, std::span<const std::uint32_t> seeds) {
            try {
                return render(settings, seeds);
            } catch (const std::bad_alloc&) {
                fail("rendering with {}: the machine is out of memory",
                     command_options(settings, methods));
            }
        };
}

enum class Outcome { rendered, failed, interrupted };

/// Renders a setting once, without measuring it. If it fails, for example because memory ran out,
/// other settings may still work.
Outcome try_pilot(const RenderTrials& render, const RenderSettings& settings, Trial& trial) {
    try {
        std::optional<Trials> pilot = render(settings, pilot_seed);
        if (!pilot) {
            return Outcome::interrupted;
        }
        trial = std::move(pilot->trials[0]);
        return Outcome::rendered;
    } catch (const Error&) {
        return Outcome::failed;
    }
}

bool learns_bandwidth(const MethodInfo& method) {
    return std::any_of(method.options.begin(), method.options.end(),
                       [](const Option& option) { return option.sweep.around != nullptr; });
}

/// Finds the bandwidths that each method chooses for the base, if it can be rendered. Returns false
/// if it was interrupted.
bool learn_bandwidths(const TradeoffRequest& request, const RenderTrials& render,
                      LearntBandwidths& learnt) {
    for (const std::string& method : request.methods) {
        if (!learns_bandwidth(request.table.at(method)) || learnt.contains(method)) {
            continue;
        }
        RenderSettings settings = request.base;
        settings.method = method;
        Trial pilot;
        const Outcome outcome = try_pilot(render, settings, pilot);
        if (outcome == Outcome::interrupted) {
            return false;
        }
        if (outcome == Outcome::rendered) {
            learnt[method] = pilot.statistics;
        }
    }
    return true;
}

/// Settings by their numbers of photons and samples, largest first.
using ByWork = std::map<std::pair<std::uint64_t, std::uint64_t>, RenderSettings, std::greater<>>;

/// Renders for each method the largest numbers of photons and samples that can be rendered. The
/// errors of these pictures are about the least that the sweep will measure. Returns nothing if it
/// was interrupted.
std::optional<std::vector<Image>> render_pilots(const std::vector<Setting>& settings,
                                                const RenderTrials& render) {
    std::map<std::string, ByWork> methods;
    for (const Setting& setting : settings) {
        const RenderSettings& s = setting.render;
        methods[s.method].try_emplace({s.photons, s.samples}, s);
    }
    std::vector<Image> pictures;
    for (const auto& [method, by_work] : methods) {
        for (const auto& [work, render_settings] : by_work) {
            Trial pilot;
            const Outcome outcome = try_pilot(render, render_settings, pilot);
            if (outcome == Outcome::interrupted) {
                return std::nullopt;
            }
            if (outcome == Outcome::rendered) {
                pictures.push_back(std::move(pilot.picture));
                break;
            }
        }
    }
    return pictures;
}

std::optional<Reference> make_reference(const TradeoffRequest& request, const MethodInfo& method,
                                        const std::vector<Setting>& settings,
                                        const RenderTrials& render) {
    const std::optional<std::vector<Image>> pilots = render_pilots(settings, render);
    return pilots
               ? render_reference(render, request.base, *pilots, request.reference_seconds, method)
               : std::nullopt;
}

/// File name of a setting's picture, which tells users the setting.
std::string picture_file(const Setting& setting) {
    const std::string value = setting.value.empty() ? "" : "-" + setting.value;
    return fmt::format("pictures/{}-{}{}.exr", setting.render.method, setting.option, value);
}

/// Adds a measurement or a failure to the results. Returns false if it was interrupted.
bool measure_setting(const TradeoffRequest& request, const Setting& setting,
                     const RenderTrials& render, const Reference& reference, Results& results) {
    std::vector<std::uint32_t> seeds(request.seeds);
    std::iota(seeds.begin(), seeds.end(), 0u);
    std::optional<Trials> trials;
    try {
        trials = render(setting.render, seeds);
    } catch (const Error& error) {
        results.failures.push_back({setting.options, error.what()});
        return true;
    }
    if (!trials) {
        return false;
    }
    Measurement measurement = measure(setting, *trials, reference);
    measurement.picture = picture_file(setting);
    write_exr(request.folder / measurement.picture,
              std::array{Layer{"", trials->trials[0].picture}});
    results.measurements.push_back(std::move(measurement));
    return true;
}

/// The keys in which two runs differ, with both values.
std::string differences(const nlohmann::ordered_json& before, const nlohmann::ordered_json& now) {
    const auto value = [](const nlohmann::ordered_json& run, const std::string& key) {
        if (!run.contains(key)) {
            return std::string("none");
        }
        return run.at(key).is_string() ? one_line(run.at(key).get<std::string>())
                                       : run.at(key).dump();
    };
    nlohmann::ordered_json keys = before;
    keys.update(now);
    std::vector<std::string> texts;
    for (const auto& [key, any] : keys.items()) {
        if (value(before, key) != value(now, key)) {
            texts.push_back(
                fmt::format("{} ({}, now {})", key, value(before, key), value(now, key)));
        }
    }
    return fmt::format("{}", fmt::join(texts, ", "));
}

/// The results in the folder, without settings whose picture is lost. Nothing if there are none.
/// Throws Error if they belong to another run.
std::optional<Results> results_before(const TradeoffRequest& request,
                                      const nlohmann::ordered_json& run) {
    const fs::path file = results_file(request.folder);
    if (!fs::exists(file)) {
        return std::nullopt;
    }
    Results results = read_results(file);
    if (results.run != run) {
        fail("resuming '{}': it is of another {}; remove the folder, or choose another with -o",
             file.string(), differences(results.run, run));
    }
    std::erase_if(results.measurements,
                  [&](const Measurement& m) { return !fs::exists(request.folder / m.picture); });
    return results;
}

std::vector<Setting> not_measured(const std::vector<Setting>& settings, const Results& results) {
    std::set<std::string> known;
    for (const Measurement& measurement : results.measurements) {
        known.insert(measurement.key);
    }
    std::vector<Setting> open;
    std::copy_if(settings.begin(), settings.end(), std::back_inserter(open),
                 [&](const Setting& setting) { return !known.contains(setting.key); });
    return open;
}

} // namespace

fs::path reference_file(const fs::path& folder) { return folder / "reference.exr"; }

Results measure_tradeoff(const TradeoffRequest& request, const Scene& scene,
                         const RenderTrials& trials, const OnStep& on_step) {
    const RenderTrials render = without_bad_alloc(trials, request.table);
    const nlohmann::ordered_json run = run_of(request);
    const std::optional<Results> before = results_before(request, run);
    std::optional<Reference> reference;
    const bool is_kept = before && fs::exists(reference_file(request.folder));
    if (is_kept) {
        reference = reread_reference(reference_file(request.folder));
    } else if (!request.reference_files.empty()) {
        reference =
            read_reference(request.reference_files, request.base.width, request.base.height);
    }
    make_folder(request.folder / "pictures");
    Results results = before.value_or(Results{.run = run});
    results.complete = false;
    results.failures.clear();
    on_step("rendering a reference", 0);
    if (!learn_bandwidths(request, render, results.learnt)) {
        return results;
    }
    const std::vector<Setting> settings =
        sweep(scene, request.base, request.methods, results.learnt, request.extent, request.table);
    if (!reference) {
        const MethodInfo* method = reference_method(scene, request.base, request.table);
        if (!method) {
            fail("rendering a reference: no method is unbiased; give a picture with --reference");
        }
        results.reference_method = method->name;
        results.reference_is_blind = is_blind_to_caustics(scene);
        reference = make_reference(request, *method, settings, render);
    }
    if (!reference) {
        return results;
    }
    if (!is_kept) {
        write_reference(reference_file(request.folder), *reference);
        results.reference_samples = reference->samples;
        results.reference_error = reference->own_error;
        results.least_error = least_error_of(*reference);
        save(request.folder, results);
    }
    const std::vector<Setting> open = not_measured(settings, results);
    std::size_t done = settings.size() - open.size();
    for (const Setting& setting : open) {
        on_step("measuring", static_cast<double>(done) / static_cast<double>(settings.size()));
        if (!measure_setting(request, setting, render, *reference, results)) {
            break;
        }
        ++done;
        save(request.folder, results);
    }
    results.complete = done == settings.size();
    save(request.folder, results);
    return results;
}

} // namespace argand
