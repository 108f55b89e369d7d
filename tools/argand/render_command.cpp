#include "commands.hpp"

#include "backend_options.hpp"
#include "base/atomic_write.hpp"
#include "base/clock.hpp"
#include "base/error.hpp"
#include "base/interrupt.hpp"
#include "base/json.hpp"
#include "image/files.hpp"
#include "method_options.hpp"
#include "numbers.hpp"
#include "overwriting.hpp"
#include "render_frames.hpp"
#include "rendering.hpp"
#include "session/checkpoint.hpp"

#include <algorithm>
#include <filesystem>
#include <memory>

namespace argand {

namespace {

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

/// Throws UsageError on options that do not go with checkpoints, Error on a file that cannot be
/// one.
void check_checkpoints(const RenderOptions& options, const CLI::App& command) {
    const bool shows_pictures = is_progressive(options.method(), options.settings) &&
                                !is_autotuned(options, command) && options.frames.empty();
    if (options.checkpoint.empty() && is_given(command, "--every") && !shows_pictures) {
        throw UsageError("reading --every: it needs --checkpoint FILE, the file to write, or a "
                         "progressive render, which saves its picture");
    }
    if (!has_checkpoints(options)) {
        return;
    }
    if (!options.frames.empty()) {
        throw UsageError("reading --checkpoint and --resume: a film goes on after its last whole "
                         "frame with --continue; leave them out");
    }
    if (is_autotuned(options, command)) {
        throw UsageError("reading --checkpoint and --resume: they need a render whose passes are "
                         "known; leave out --target-error, and give --method with --budget");
    }
    if (!options.checkpoint.empty()) {
        check_checkpoint_writable(options.checkpoint, options.resume);
    }
}

/// Throws UsageError on options that do not go with widths that fall from pass to pass, or not
/// without.
void check_progressive(const RenderOptions& options, const CLI::App& command) {
    if (!is_progressive(options.method(), options.settings)) {
        for (const char* option : {"--passes", "--r1", "--radius-exponent"}) {
            if (is_given(command, option)) {
                throw UsageError(fmt::format(
                    "reading {}: it has no effect without --progressive; add that", option));
            }
        }
        return;
    }
    const RenderSettings& settings = options.settings;
    for (const auto& [option, fixes] :
         {std::pair{"--radius", settings.radius.has_value()},
          std::pair{"--fixed-smoothing", settings.footprints.fixed_smoothing}}) {
        if (fixes) {
            throw UsageError(
                fmt::format("reading {}: progressive widths fall from that of the first "
                            "pass; set that with --r1 or --smoothing",
                            option));
        }
    }
    if (is_given(command, "--passes") && (options.settings.budget || options.target_error)) {
        throw UsageError("reading --passes: with --budget or --target-error there are as many "
                         "passes as that takes; leave one of the two out");
    }
}

/// Throws UsageError on options of queries that are answered together, if each is by itself.
void check_query(const RenderOptions& options, const CLI::App& command) {
    if (options.settings.query == QuerySearch::simultaneous) {
        return;
    }
    for (const char* option : {"--query-leaf", "--partition-cost", "--frontier-memory"}) {
        if (is_given(command, option)) {
            throw UsageError(fmt::format(
                "reading {}: it has no effect without --query simultaneous; add that", option));
        }
    }
}

/// Throws UsageError on options that choose other numbers than those of a lattice.
void check_deterministic(const RenderOptions& options, const CLI::App& command) {
    if (!options.settings.deterministic) {
        return;
    }
    for (const char* option : {"--seed", "--seed-per-frame", "--photon-sampling"}) {
        if (is_given(command, option)) {
            throw UsageError(fmt::format("reading {}: with --deterministic there is nothing random "
                                         "to choose; leave one of the two out",
                                         option));
        }
    }
}

/// Throws UsageError on options of a kd-tree, if there is none.
void check_tracer(const RenderOptions& options, const CLI::App& command) {
    if (!options.tracer.kdtree && is_given(command, "--tree-memory")) {
        throw UsageError(
            "reading --tree-memory: it has no effect without --tracer kdtree; add that");
    }
}

void check_lens(const RenderOptions& options) {
    if (options.settings.focus && !(options.settings.aperture > 0)) {
        throw UsageError("reading --focus: it has no effect without --aperture; add that");
    }
}

/// Throws UsageError on options of how radiance becomes colours, if no output has colours.
void check_display(const RenderOptions& options, const CLI::App& command) {
    if (std::all_of(options.outputs.begin(), options.outputs.end(),
                    [](const std::string& name) { return lower_extension(name) == ".exr"; })) {
        for (const char* option : {"--exposure", "--tone"}) {
            if (is_given(command, option)) {
                throw UsageError(fmt::format("reading {}: it has no effect on .exr files, which "
                                             "hold radiance; add -o FILE.png",
                                             option));
            }
        }
    }
}

/// Throws UsageError on layers that no file would have, or that cannot be found.
void check_layers(const RenderOptions& options, const CLI::App& command) {
    const FeatureLayers& layers = options.picture.layers;
    if (!is_given(command, "--aovs")) {
        return;
    }
    if (std::none_of(options.outputs.begin(), options.outputs.end(),
                     [](const std::string& name) { return lower_extension(name) == ".exr"; })) {
        throw UsageError("reading --aovs: only .exr files have further layers; add -o FILE.exr");
    }
    if (!layers.variance) {
        return;
    }
    if (has_checkpoints(options)) {
        throw UsageError("reading --aovs variance: checkpoints do not save it; leave it out, or "
                         "--checkpoint and --resume");
    }
    if (is_autotuned(options, command)) {
        throw UsageError("reading --aovs variance: it needs passes that are known; leave out "
                         "--target-error, and give --method with --budget");
    }
    if (options.settings.samples < 2 && !options.settings.budget) {
        throw UsageError("reading --aovs variance: one sample does not vary; give --spp 2 or more");
    }
}

void check(const RenderOptions& options, const CLI::App& command) {
    check_lens(options);
    check_display(options, command);
    check_layers(options, command);
    check_query(options, command);
    check_deterministic(options, command);
    check_tracer(options, command);
    check_methods({options.settings.method}, options.methods);
    check_checkpoints(options, command);
    if (is_autotuned(options, command)) {
        check_autotuned(options, command);
    }
    check_method_options(command, options.method(), options.methods);
    check_progressive(options, command);
    check_frames(options, command);
    parse_crop(options.picture.crop, parse_picture_size(options.size));
    std::vector<std::string> files{options.scene};
    if (!options.env.empty()) {
        files.push_back(options.env);
    }
    if (!options.edits.empty()) {
        files.push_back(options.edits);
    }
    const std::vector<std::string> inputs = files;
    for (const std::string& checkpoint : {options.checkpoint, options.resume}) {
        if (!checkpoint.empty()) {
            files.push_back(checkpoint);
            files.push_back(older_checkpoint(checkpoint).string());
        }
    }
    if (!options.checkpoint.empty()) {
        check_overwrites_none(options.checkpoint, inputs);
        check_overwrites_none(older_checkpoint(options.checkpoint).string(), inputs);
    }
    for (const std::string& output : options.outputs) {
        check_overwrites_none(output, files);
        check_output(options, output);
        files.push_back(output);
    }
    if (!options.report.empty()) {
        check_overwrites_none(options.report, files);
        check_writable(options.report);
    }
}

void render_one(const RenderOptions& options, const CLI::App& command) {
    const Clock::time_point start = Clock::now();
    RenderJob job = open_job(options, command, options.seconds);
    const Rendered rendered = render_picture(job, "rendering");
    if (rendered.result.statistics.samples == 0) {
        fail("rendering '{}': interrupted {}; nothing is written", options.scene,
             rendered.tuned && rendered.tuned->candidates.empty()
                 ? "while methods were tried"
                 : "before the first pass was finished");
    }
    write_picture(job, rendered, options.outputs);
    if (!options.report.empty()) {
        write_json(options.report, report_on(job, rendered, options.outputs));
    }
    tell_of(job, rendered, options.outputs, seconds_since(start));
}

void run(RenderOptions& options, const CLI::App& command) {
    if (options.outputs.empty()) {
        const std::string stem = std::filesystem::path(options.scene).stem().string();
        options.outputs.push_back(stem + (options.frames.empty() ? ".png" : "_%04d.png"));
    }
    check(options, command);
    catch_interrupts();
    if (options.frames.empty()) {
        render_one(options, command);
    } else {
        render_frames(options, command);
    }
}

} // namespace

void add_render_command(CLI::App& app, MethodTable methods, const std::string& command_line) {
    CLI::App* command = app.add_subcommand("render", "Render a scene to pictures and films");
    auto options = std::make_shared<RenderOptions>(RenderOptions{SceneOptions(), methods});
    RenderSettings& settings = options->settings;
    settings.method = methods.begin()->name;
    options->picture.command = command_line;
    add_scene_options(*command, *options);
    command
        ->add_option(
            "-o,--output", options->outputs,
            "Picture to write, .png or .exr, or with --frames a film, .mp4 or .webm, which "
            "needs ffmpeg; may be given several times (default: SCENE's name with .png)")
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
    add_picture_options(*command, options->picture);
    command->add_flag("--everything", settings.everything,
                      "Also compile and run code that the scene does not require: the picture is "
                      "the same; measures the cost");
    command
        ->add_option_function<std::string>(
            "--tracer",
            [options](const std::string& tracer) { options->tracer.kdtree = tracer == "kdtree"; },
            "Tree through which rays go: lbvh (bounding boxes) or kdtree (default: lbvh); the "
            "picture is the same")
        ->check(CLI::IsMember({"lbvh", "kdtree"}));
    command
        ->add_option("--tree-memory", options->tracer.tree_memory,
                     "With --tracer kdtree: bytes of the tree; nodes that would need more are not "
                     "split")
        ->capture_default_str()
        ->check(integer_between(1, 1'000'000'000'000));
    command
        ->add_option("--frames", options->frames,
                     "Render frames A to B - 1 of the scene's animations, written A:B; frame k "
                     "is at k / --fps seconds. The -o of pictures needs a place for k, such as "
                     "frame_%04d.png; film.mp4 is a film of all frames")
        ->check([](const std::string& range) {
            return range.empty() ? "write A:B for the frames from A up to B - 1" : "";
        });
    command->add_option("--fps", options->frames_per_second, "Frames a second")
        ->capture_default_str()
        ->check(number_between(1e-6, 1e6));
    command->add_flag("--seed-per-frame", options->seed_per_frame,
                      "Give each frame noise of its own: frame k has the seed --seed + k");
    command->add_option("--shutter", options->shutter,
                        "Motion blur: a frame sees what happens from OPEN to CLOSE after its "
                        "moment, in shares of a frame, such as 0:0.5. Each pass sees a moment "
                        "of its own; there are at least --spp passes, which share the photons");
    command->add_flag("--continue", options->continues,
                      "Leave out frames whose files exist, to go on after an interruption");
    command
        ->add_option("--keep", options->keep,
                     "What frames keep for the next ones: all of a method's memory, or none. "
                     "Pictures are the same, but for photon-queue, whose photons it drops")
        ->capture_default_str()
        ->check(CLI::IsMember({"all", "none"}));
    command->add_option("--checkpoint", options->checkpoint,
                        "File to which the state of the render is saved now and then and at its "
                        "end; the one before it stays, as FILE.old");
    command
        ->add_option("--every", options->every,
                     "Seconds between checkpoints; a progressive render then also writes its "
                     "picture so far, also without --checkpoint")
        ->capture_default_str()
        ->check(number_between(0, 1e9));
    command->add_option("--resume", options->resume,
                        "Checkpoint to go on from: the picture is that of a render that was never "
                        "interrupted");
    add_backend_options(*command, options->backend, options->device);
    command->add_option("--json", options->report,
                        "Write a report of parameters, times and memory to this file; with "
                        "--frames, one line for each frame");
    command->add_flag("-q,--quiet", options->quiet, "Print errors only");
    command->footer(describe_methods(methods) +
                    "\n\nExample:\n  argand render assets/cornell_glass.glb -o glass.png -o "
                    "glass.exr --size 256x256");
    command->callback([options, command] { run(*options, *command); });
}

} // namespace argand
