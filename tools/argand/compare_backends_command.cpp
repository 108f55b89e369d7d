#include "commands.hpp"

#include "base/atomic_write.hpp"
#include "base/error.hpp"
#include "base/json.hpp"
#include "compare/backends.hpp"
#include "environment_options.hpp"
#include "method_options.hpp"
#include "numbers.hpp"
#include "overwriting.hpp"
#include "picture_size.hpp"
#include "scene/fingerprint.hpp"

#include <algorithm>
#include <memory>

namespace argand {

namespace {

struct BackendOptions {
    MethodTable table;
    std::string scene;
    EnvironmentOptions sky;
    std::string a = "vulkan";
    std::string b = "cpu";
    std::string device_a, device_b;
    std::vector<std::string> methods;
    std::string size = "64x64";
    RenderSettings settings{.samples = 4, .photons = 20'000};
    std::string golden;
    std::string record;
    std::string revision = ARGAND_VERSION;
    bool json = false;
};

using Passes = bool (*)(const StageComparison&);

void print(const char* kind, const std::vector<StageComparison>& stages, Passes passes) {
    fmt::print("  {:<18}{:>11}{:>11}{:>10}{:>12}{:>12}{:>10}{:>10}  {}\n", kind, "items", "unequal",
               "diverged", "largest ULP", "relative", "A, ms", "B, ms", "verdict");
    for (const StageComparison& stage : stages) {
        fmt::print("  {:<18}{:>11}{:>11}{:>10}{:>12}{:>12.2g}{:>10.2f}{:>10.2f}  {}\n", stage.name,
                   stage.items, stage.unequal, stage.diverged, stage.largest_ulp,
                   stage.largest_relative, 1e3 * stage.seconds_a, 1e3 * stage.seconds_b,
                   passes(stage) ? "same" : "DIFFERENT");
    }
}

nlohmann::ordered_json to_json(const std::vector<StageComparison>& stages, Passes passes) {
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
                        {"same", passes(stage)}});
    }
    return rows;
}

void fail_different(const BackendOptions& options) {
    fail("comparing {} with {} on '{}': they differ by more than the tolerance; the verdicts name "
         "the stages",
         options.a, options.b, options.scene);
}

void compare_live(const BackendOptions& options, const Scene& scene) {
    const std::unique_ptr<Device> a = open_device(options.device_a, options.a);
    const std::unique_ptr<Device> b = open_device(options.device_b, options.b);
    nlohmann::ordered_json report = {
        {"scene", options.scene}, {"a", a->info().name}, {"b", b->info().name}};
    bool same = true;
    for (const std::string& method : options.methods) {
        RenderSettings settings = options.settings;
        settings.method = method;
        const BackendComparison found = compare_backends(*a, *b, scene, settings, options.table);
        same = same && passes(found);
        report["methods"][method] = {{"relMSE", found.rel_mse},
                                     {"render_seconds_a", found.seconds_a},
                                     {"render_seconds_b", found.seconds_b},
                                     {"isolated", to_json(found.isolated, passes_isolated)},
                                     {"end_to_end", to_json(found.end_to_end, passes_end_to_end)}};
        if (!options.json) {
            fmt::print("{}, {}: A {} ({:.3f} s), B {} ({:.3f} s), relMSE of the pictures {:.3g}\n",
                       options.scene, method, a->info().name, found.seconds_a, b->info().name,
                       found.seconds_b, found.rel_mse);
            print("isolated", found.isolated, passes_isolated);
            print("end to end", found.end_to_end, passes_end_to_end);
        }
    }
    if (options.json) {
        fmt::print("{}", json_text(report));
    }
    if (!same) {
        fail_different(options);
    }
}

void compare_golden(const BackendOptions& options, const Scene& scene) {
    const Golden golden = read_golden(options.golden);
    const std::unique_ptr<Device> device = open_device(options.device_a, options.a);
    // Each stage starts from the results of the recorded device.
    nlohmann::ordered_json report = {{"scene", options.scene},   {"a", golden.device},
                                     {"b", device->info().name}, {"golden", options.golden},
                                     {"driver", golden.driver},  {"revision", golden.revision}};
    bool same = true;
    for (const auto& [method, capture] : golden.captures) {
        const std::vector<StageComparison> found =
            compare_with_golden(golden, method, *device, scene, options.table);
        same = same && std::all_of(found.begin(), found.end(), passes_isolated);
        report["methods"][method] = {{"isolated", to_json(found, passes_isolated)}};
        if (!options.json) {
            fmt::print("{}, {}: A {} (recorded, {}, {}), B {}\n", options.scene, method,
                       golden.device, golden.driver, golden.revision, device->info().name);
            print("isolated", found, passes_isolated);
        }
    }
    if (options.json) {
        fmt::print("{}", json_text(report));
    }
    if (!same) {
        fail_different(options);
    }
}

void record(const BackendOptions& options, const Scene& scene) {
    const std::unique_ptr<Device> device = open_device(options.device_a, options.a);
    Golden golden{.scene = scene.name,
                  .fingerprint = fingerprint(scene),
                  .device = device->info().name,
                  .driver = device->info().driver,
                  .revision = options.revision,
                  .features = {.lane_serial = device->info().lane_serial()},
                  .width = options.settings.width,
                  .height = options.settings.height,
                  .samples = options.settings.samples,
                  .seed = options.settings.seed,
                  .photons = options.settings.photons,
                  .captures = {}};
    for (const std::string& method : options.methods) {
        RenderSettings settings = options.settings;
        settings.method = method;
        golden.captures[method] = record_golden(*device, scene, settings, options.table);
    }
    write_golden(options.record, golden);
    fmt::print("{}: {} by {}\n", options.record, fmt::join(options.methods, ", "), golden.device);
}

void run(BackendOptions& options) {
    check_methods(options.methods, options.table);
    if ((options.b == "golden") != !options.golden.empty()) {
        throw UsageError("comparing with a golden capture: give both --b golden and --golden FILE");
    }
    const PictureSize size = parse_picture_size(options.size);
    options.settings.width = size.width;
    options.settings.height = size.height;
    if (!options.record.empty()) {
        check_overwrites_none(options.record, {options.scene});
        check_writable(options.record);
    }
    const Scene scene = load_scene(options.scene, options.sky);
    if (!options.record.empty()) {
        record(options, scene);
    } else if (!options.golden.empty()) {
        compare_golden(options, scene);
    } else {
        compare_live(options, scene);
    }
}

} // namespace

void add_compare_backends_command(CLI::App& app, MethodTable methods) {
    CLI::App* command =
        app.add_subcommand("compare-backends", "Compare two backends stage by stage");
    auto options = std::make_shared<BackendOptions>(
        BackendOptions{.table = methods, .methods = methods.names()});
    const std::string backends = fmt::format("{}", fmt::join(backend_names(), ", "));
    command->add_option("scene", options->scene, "glTF 2.0 file (.gltf, .glb)")->required();
    add_environment_options(*command, options->sky);
    command->add_option("--a", options->a, backends)->capture_default_str();
    command->add_option("--b", options->b, backends + ", golden (with --golden)")
        ->capture_default_str();
    command->add_option("--device-a", options->device_a,
                        "Device of --a by index or part of its name (see `argand devices`)");
    CLI::Option* device_b = command->add_option("--device-b", options->device_b, "Device of --b");
    CLI::Option* golden = command->add_option(
        "--golden", options->golden,
        "With --b golden: file of the capture, which also holds size, samples and photons");
    CLI::Option* record = command->add_option(
        "--record", options->record, "Record the work of --a in this file instead of comparing");
    command
        ->add_option("--revision", options->revision,
                     "With --record: name of the revision that the capture is of")
        ->capture_default_str();
    command
        ->add_option("--methods", options->methods,
                     fmt::format("{}", fmt::join(methods.names(), ",")))
        ->delimiter(',');
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
    CLI::Option* json = command->add_flag("--json", options->json, "Print JSON");
    record->excludes(golden)->excludes("--b")->excludes(device_b)->excludes(json);
    golden->excludes(device_b);
    for (const char* held : {"--methods", "--size", "--spp", "--photons", "--seed"}) {
        golden->excludes(held);
    }
    command->footer(
        "Isolated: every stage of B starts from the data that A had before it. Integers must be "
        "equal to the bit; of the floats, one item in 10,000 may differ by more than 1e-5. End to "
        "end: B continues with its own results, and one item in 100 may diverge, because one "
        "rounding can send a path another way. The exit status is 1 if more differ.\n\n"
        "Example:\n  argand compare-backends assets/cornell_glass.glb --a vulkan --b cpu\n"
        "  argand compare-backends assets/cornell_glass.glb --a cuda --record glass.golden --size "
        "8x8 --spp 1 --photons 200");
    command->callback([options] { run(*options); });
}

} // namespace argand
