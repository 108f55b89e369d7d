#include "commands.hpp"

#include "autotune/autotune.hpp"
#include "backend_options.hpp"
#include "base/atomic_write.hpp"
#include "base/clock.hpp"
#include "base/error.hpp"
#include "base/interrupt.hpp"
#include "base/json.hpp"
#include "base/progress.hpp"
#include "image/files.hpp"
#include "method_options.hpp"
#include "numbers.hpp"
#include "overwriting.hpp"
#include "picture_size.hpp"
#include "report.hpp"
#include "scene/gltf.hpp"
#include "scene_options.hpp"

#include <algorithm>
#include <charconv>
#include <memory>

namespace argand {

namespace {

struct RenderOptions : SceneOptions {
    MethodTable methods;
    std::vector<std::string> outputs;
    std::string size = "512x512";
    std::string camera;
    std::string backend = "auto";
    std::string device;
    std::string report;
    float exposure = 0;
    bool quiet = false;
    std::optional<double> target_error;
    RenderSettings settings;

    const MethodInfo& method() const { return methods.at(settings.method); }
};

/// A render, and how it was autotuned, if it was.
struct Rendered {
    RenderResult result;
    std::optional<AutotunedRender> tuned;
};

std::size_t find_camera(const Scene& scene, const std::string& choice) {
    if (choice.empty()) {
        return 0;
    }
    for (std::size_t i = 0; i < scene.cameras.size(); ++i) {
        if (scene.cameras[i].name == choice) {
            return i;
        }
    }
    std::size_t index = 0;
    const auto [end, error] = std::from_chars(choice.data(), choice.data() + choice.size(), index);
    if (error == std::errc() && end == choice.data() + choice.size() &&
        index < scene.cameras.size()) {
        return index;
    }
    fail("choosing camera '{}' of '{}': there is none of that name or index; `argand inspect` "
         "lists its {} cameras",
         choice, scene.name, scene.cameras.size());
}

/// Whether Argand is to choose the method or the numbers of photons and samples.
bool is_autotuned(const RenderOptions& options, const CLI::App& command) {
    return options.target_error || (options.settings.budget && !is_given(command, "--method"));
}

/// Throws UsageError on options that fix a choice which is left to Argand.
void check_autotuned(const RenderOptions& options, const CLI::App& command) {
    const MethodTable methods = options.methods;
    if (!is_given(command, "--method")) {
        // Every photon-mapping candidate must have the option; `path`, which may be picked too, is
        // not checked.
        for (const MethodInfo& method : methods) {
            if (method.trial != TrialOrder::never) {
                check_method_options(command, method, methods);
            }
        }
    }
    for (const Option* option : methods.options()) {
        if (option->fixes_bandwidth && is_given(command, "--" + option->name)) {
            throw UsageError(fmt::format("reading --{}: with --target-error, or --budget without "
                                         "--method, Argand chooses the widths of estimation; "
                                         "leave one of the two out",
                                         option->name));
        }
    }
    if (is_given(command, "--photons") && options.settings.photons == 0) {
        throw UsageError("reading --photons 0: without photons the error of indirect light does "
                         "not fall; leave it out");
    }
}

void check(const RenderOptions& options, const CLI::App& command) {
    check_methods({options.settings.method}, options.methods);
    if (is_autotuned(options, command)) {
        check_autotuned(options, command);
    }
    check_method_options(command, options.method(), options.methods);
    std::vector<std::string> files{options.scene};
    for (const std::string& output : options.outputs) {
        check_overwrites_none(output, files);
        check_image_writable(output);
        files.push_back(output);
    }
    if (!options.report.empty()) {
        check_overwrites_none(options.report, files);
        check_writable(options.report);
    }
}

/// Picks the method if it is left to Argand and is not autotuned. Options that the user has set and
/// the method does not have keep the default method.
void choose_method(RenderOptions& options, const CLI::App& command, const Scene& scene) {
    if (is_given(command, "--method") || is_autotuned(options, command)) {
        return;
    }
    const MethodInfo& method = method_for(scene, options.settings, options.methods);
    const std::vector<const Option*> all = options.methods.options();
    if (std::none_of(all.begin(), all.end(), [&](const Option* option) {
            return !method.option(option->name) && is_given(command, "--" + option->name);
        })) {
        options.settings.method = method.name;
    }
}

Rendered render_on(Device& device, const Scene& scene, RenderOptions& options,
                   const CLI::App& command) {
    std::optional<Progress> progress;
    const OnProgress on_progress = [&](double done) {
        progress->update(done);
        return !interrupted();
    };
    if (!is_autotuned(options, command)) {
        progress.emplace("rendering", options.quiet);
        return {render(device, scene, options.settings, on_progress, nullptr, options.methods),
                std::nullopt};
    }
    // How long pilots take shows only as they run.
    progress.emplace("trying methods", options.quiet);
    bool picked_one = false;
    const Target target{.error = options.target_error,
                        .seconds = options.settings.budget,
                        .methods = options.methods};
    const UserSet user_set{.method = is_given(command, "--method"),
                           .samples = is_given(command, "--spp"),
                           .photons = is_given(command, "--photons")};
    const RenderPasses passes = [&](const RenderSettings& settings, const OnPass& on_pass) {
        return render(
            device, scene, settings,
            [&](double done) { return on_progress(picked_one ? done : 0); }, on_pass,
            options.methods);
    };
    AutotunedRender tuned = autotune(
        passes, scene, options.settings, user_set, target, [&](const AutotunedRender& picked) {
            progress.reset();
            if (!options.quiet) {
                fmt::print(stderr, "argand: picked {}\n", describe_pick(picked));
            }
            progress.emplace("rendering", options.quiet);
            picked_one = true;
        });
    options.settings = tuned.settings;
    options.settings.budget = target.seconds;
    RenderResult result = std::move(tuned.result);
    return {std::move(result), std::move(tuned)};
}

/// Notes for the user on a render that took this time.
std::vector<std::string> notes_on(const RenderOptions& options, const Rendered& rendered,
                                  double seconds) {
    constexpr double clearly_more = 1.2;
    const RenderSettings& settings = options.settings;
    const std::uint64_t passes = rendered.result.statistics.passes;
    std::vector<std::string> notes;
    if (rendered.tuned) {
        notes.push_back(describe_outcome(*rendered.tuned));
    }
    if (settings.budget && seconds > clearly_more * *settings.budget) {
        notes.push_back(
            fmt::format("rendering took {:.3g} s in {} pass{}, not the {:.3g} s of "
                        "--budget; passes are shorter "
                        "with a lower --spp{}",
                        seconds, passes, passes == 1 ? "" : "es", *settings.budget,
                        options.method().option("photons") ? " or fewer --photons" : ""));
    }
    return notes;
}

/// Tells the user, unless to be quiet.
void print_notes(const RenderOptions& options, const std::vector<std::string>& notes) {
    for (const std::string& note : notes) {
        if (!options.quiet) {
            fmt::print(stderr, "argand: note: {}\n", note);
        }
    }
}

void render_file(RenderOptions& options, const CLI::App& command) {
    const PictureSize size = parse_picture_size(options.size);
    options.settings.width = size.width;
    options.settings.height = size.height;
    if (options.outputs.empty()) {
        options.outputs.push_back(
            std::filesystem::path(options.scene).filename().replace_extension(".png").string());
    }
    check(options, command);
    catch_interrupts();

    ReportTimes times;
    const Clock::time_point start = Clock::now();
    const Scene scene = load_gltf(options.scene, options.seconds);
    times.load = seconds_since(start);
    options.settings.camera = find_camera(scene, options.camera);
    choose_method(options, command, scene);
    print_notes(options, scene.notes);
    const Clock::time_point opened = Clock::now();
    std::unique_ptr<Device> device = open_backend(options.backend, options.device, options.quiet);
    times.open = seconds_since(opened);

    Clock::time_point rendering = Clock::now();
    Rendered rendered;
    try {
        rendered = render_on(*device, scene, options, command);
    } catch (const DeviceFault& fault) {
        device = open_after_fault(options.backend, options.device, fault);
        rendering = Clock::now();
        rendered = render_on(*device, scene, options, command);
    }
    const RenderResult& result = rendered.result;
    times.render = seconds_since(rendering);
    const std::vector<std::string> notes = notes_on(options, rendered, times.render);
    if (result.statistics.samples == 0) {
        fail("rendering '{}': interrupted {}; nothing is written", options.scene,
             rendered.tuned && rendered.tuned->candidates.empty()
                 ? "while methods were tried"
                 : "before the first pass was finished");
    }
    const Clock::time_point writing = Clock::now();
    for (const std::string& output : options.outputs) {
        write_image(output, result.layers, options.exposure);
    }
    times.write = seconds_since(writing);
    if (!options.report.empty()) {
        nlohmann::ordered_json report = render_report({.device = *device,
                                                       .scene = scene,
                                                       .method = options.method(),
                                                       .settings = options.settings,
                                                       .exposure = options.exposure,
                                                       .outputs = options.outputs,
                                                       .statistics = result.statistics,
                                                       .times = times});
        for (const std::string& note : notes) {
            report["notes"].push_back(note);
        }
        if (rendered.tuned) {
            report["aim"] = autotune_report(*rendered.tuned, options.methods);
        }
        write_json(options.report, report);
    }
    if (result.statistics.non_finite > 0) {
        fmt::print(
            stderr,
            "argand: note: {} samples were not finite and are left out; please report the scene\n",
            result.statistics.non_finite);
    }
    print_notes(options, notes);
    if (!options.quiet) {
        fmt::print("{}: {} {}x{} on {} in {:.2f} s{}\n", fmt::join(options.outputs, ", "),
                   options.settings.method, options.settings.width, options.settings.height,
                   device->info().name, seconds_since(start),
                   result.statistics.interrupted ? " (interrupted: the passes so far)" : "");
    }
}

} // namespace

void add_render_command(CLI::App& app, MethodTable methods) {
    CLI::App* command = app.add_subcommand("render", "Render a scene to PNG and OpenEXR");
    auto options = std::make_shared<RenderOptions>(RenderOptions{SceneOptions(), methods});
    RenderSettings& settings = options->settings;
    settings.method = methods.begin()->name;
    add_scene_options(*command, *options);
    command
        ->add_option("-o,--output", options->outputs,
                     "Picture to write, .png or .exr; may be given several times (default: SCENE's "
                     "name with .png)")
        ->expected(1)
        ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
    command->add_option(
        "--method", settings.method,
        fmt::format("{}; see below (default: {} where glass, mirrors or gloss may throw "
                    "caustics, else the one that --target-error tries first)",
                    fmt::join(methods.names(), ", "), methods.begin()->name));
    command->add_option("--size", options->size, "Width x height in pixels")->capture_default_str();
    command
        ->add_option("--budget", settings.budget,
                     "Seconds to render. With --method, passes of --photons and --spp are repeated "
                     "as long as there is time; without it, Argand tries methods and picks the one "
                     "with the least expected error")
        ->check(number_between(1e-3, 1e7));
    command
        ->add_option("--target-error", options->target_error,
                     "relMSE to reach (see `argand compare`): Argand tries methods and picks the "
                     "fastest; with --budget it gets as near as the time allows")
        ->check(number_between(1e-9, 1e3));
    add_method_options(*command, settings, methods);
    command->add_option("--seed", settings.seed, "Seed of the random numbers")
        ->capture_default_str()
        ->check(integer_between(0, 0xffffffff));
    command->add_option("--camera", options->camera,
                        "Name or index of the camera (default: the first)");
    command->add_option("--exposure", options->exposure, "Exposure of the PNG in stops")
        ->capture_default_str()
        ->check(number_between(-100, 100));
    command->add_flag("--everything", settings.everything,
                      "Also compile and run code that the scene does not require: the picture is "
                      "the same; measures the cost");
    add_backend_options(*command, options->backend, options->device);
    command->add_option("--json", options->report,
                        "Write a report of parameters, times and memory to this file");
    command->add_flag("-q,--quiet", options->quiet, "Print errors only");
    command->footer(describe_methods(methods) +
                    "\n\nExample:\n  argand render assets/cornell_glass.glb -o glass.png -o "
                    "glass.exr --size 256x256");
    command->callback([options, command] { render_file(*options, *command); });
}

} // namespace argand
