#include "commands.hpp"

#include "base/error.hpp"
#include "base/json.hpp"
#include "compare/backends.hpp"
#include "numbers.hpp"
#include "picture_size.hpp"
#include "scene/gltf.hpp"

#include <algorithm>
#include <memory>

namespace argand {

namespace {

struct BackendOptions {
    std::string scene;
    std::string a = "vulkan";
    std::string b = "cpu";
    std::vector<std::string> methods = method_names();
    std::string size = "64x64";
    RenderSettings settings{.samples = 4, .photons = 20'000};
    bool json = false;
};

bool row_passes(const StageComparison& stage, bool isolated) {
    return isolated && must_be_equal(stage) ? stage.unequal == 0
                                            : passes(stage, isolated ? isolated_tolerance : end_to_end_tolerance);
}

void print(const std::vector<StageComparison>& stages, bool isolated) {
    fmt::print("  {:<18}{:>11}{:>11}{:>10}{:>12}{:>12}{:>10}{:>10}  {}\n", isolated ? "isolated" : "end to end", "items",
               "unequal", "diverged", "largest ULP", "relative", "A, ms", "B, ms", "verdict");
    for (const StageComparison& stage : stages) {
        fmt::print("  {:<18}{:>11}{:>11}{:>10}{:>12}{:>12.2g}{:>10.2f}{:>10.2f}  {}\n", stage.name, stage.items,
                   stage.unequal, stage.diverged, stage.largest_ulp, stage.largest_relative, 1e3 * stage.seconds_a,
                   1e3 * stage.seconds_b, row_passes(stage, isolated) ? "same" : "DIFFERENT");
    }
}

nlohmann::ordered_json to_json(const std::vector<StageComparison>& stages, bool isolated) {
    nlohmann::ordered_json rows = nlohmann::ordered_json::array();
    for (const StageComparison& stage : stages) {
        rows.push_back({{"stage", stage.name},
                        {"runs", stage.runs},
                        {"items", stage.items},
                        {"unequal", stage.unequal},
                        {"diverged", stage.diverged},
                        {"largest_ulp", stage.largest_ulp},
                        {"largest_relative", stage.largest_relative},
                        {"seconds_a", stage.seconds_a},
                        {"seconds_b", stage.seconds_b},
                        {"same", row_passes(stage, isolated)}});
    }
    return rows;
}

void compare_on(const BackendOptions& options, Device& a, Device& b, const Scene& scene) {
    nlohmann::ordered_json report = {{"scene", options.scene}, {"a", a.info().name}, {"b", b.info().name}};
    bool same = true;
    for (const std::string& method : options.methods) {
        RenderSettings settings = options.settings;
        settings.method = method;
        const BackendComparison found = compare_backends(a, b, scene, settings);
        same = same && passes(found);
        if (options.json) {
            report["methods"][method] = {{"relMSE", found.rel_mse},
                                         {"render_seconds_a", found.seconds_a},
                                         {"render_seconds_b", found.seconds_b},
                                         {"isolated", to_json(found.isolated, true)},
                                         {"end_to_end", to_json(found.end_to_end, false)}};
            continue;
        }
        fmt::print("{}, {}: A {} ({:.3f} s), B {} ({:.3f} s), relMSE of the pictures {:.3g}\n", options.scene, method,
                   a.info().name, found.seconds_a, b.info().name, found.seconds_b, found.rel_mse);
        print(found.isolated, true);
        print(found.end_to_end, false);
    }
    if (options.json) {
        fmt::print("{}", json_text(report));
    }
    if (!same) {
        fail("comparing {} with {} on '{}': they differ by more than the tolerance; the stages are marked above",
             options.a, options.b, options.scene);
    }
}

void run(BackendOptions& options) {
    const std::vector<std::string> known = method_names();
    for (const std::string& method : options.methods) {
        if (std::find(known.begin(), known.end(), method) == known.end()) {
            throw UsageError(fmt::format("choosing method '{}': choose from {}", method, fmt::join(known, ", ")));
        }
    }
    const PictureSize size = parse_picture_size(options.size);
    options.settings.width = size.width;
    options.settings.height = size.height;
    const Scene scene = load_gltf(options.scene);
    const std::unique_ptr<Device> a = open_device("", options.a);
    const std::unique_ptr<Device> b = open_device("", options.b);
    compare_on(options, *a, *b, scene);
}

} // namespace

void add_compare_backends_command(CLI::App& app) {
    CLI::App* command = app.add_subcommand("compare-backends", "Compare two backends stage by stage");
    auto options = std::make_shared<BackendOptions>();
    const std::string backends = fmt::format("{}", fmt::join(backend_names(), ", "));
    command->add_option("scene", options->scene, "glTF 2.0 file (.gltf, .glb)")->required();
    command->add_option("--a", options->a, backends)->capture_default_str();
    command->add_option("--b", options->b, backends)->capture_default_str();
    command->add_option("--methods", options->methods, fmt::format("{}", fmt::join(method_names(), ",")))->delimiter(',');
    command->add_option("--size", options->size, "Width x height in pixels")->capture_default_str();
    command->add_option("--spp", options->settings.samples, "Eye paths per pixel")
        ->capture_default_str()
        ->check(integer_between(1, 1 << 16));
    command->add_option("--photons", options->settings.photons, "Photons emitted")
        ->capture_default_str()
        ->check(integer_between(0, 100'000'000));
    command->add_option("--seed", options->settings.seed, "Seed of the random numbers")
        ->capture_default_str()
        ->check(integer_between(0, 0xffffffff));
    command->add_flag("--json", options->json, "Print JSON");
    command->footer(
        "Isolated: every stage of B starts from what A had before it; integers must be equal to the bit, and of floats one "
        "item in 10,000 may differ by more than 0.1 %. End to end: B goes on with its own results, and of the items one in "
        "100 may have diverged, as paths do that one rounding sends another way. Exit status 1 if they differ by more.\n\n"
        "Example:\n  argand compare-backends assets/cornell_glass.glb --a vulkan --b cpu");
    command->callback([options] { run(*options); });
}

} // namespace argand
