#include "rendering.hpp"

#include "autotune/running_error.hpp"
#include "backend_options.hpp"
#include "base/clock.hpp"
#include "base/error.hpp"
#include "base/interrupt.hpp"
#include "base/progress.hpp"
#include "image/files.hpp"
#include "method_options.hpp"
#include "methods/plan_render.hpp"
#include "overwriting.hpp"
#include "picture_size.hpp"
#include "session/checkpoint.hpp"
#include "session/render.hpp"

#include <algorithm>
#include <utility>

namespace argand {

namespace {

/// Picks the method if it is left to Argand and is not autotuned. Options that the user has set and
/// the method does not have keep the default method.
void choose_method(RenderSettings& settings, const RenderOptions& options, const CLI::App& command,
                   const Scene& scene) {
    if (is_given(command, "--method") || is_autotuned(options, command)) {
        return;
    }
    const MethodInfo& method = method_for(scene, options.settings, options.methods);
    const std::vector<const Option*> all = options.methods.options();
    if (std::none_of(all.begin(), all.end(), [&](const Option* option) {
            return !method.option(option->name) && is_given(command, "--" + option->name);
        })) {
        settings.method = method.name;
    }
}

/// Asks for the variance, and for passes from which it can be told.
RenderSettings with_variance(RenderSettings settings) {
    constexpr std::uint32_t most = 64;
    settings.variance = true;
    settings.least_passes = std::max(settings.least_passes, std::min(settings.samples, most));
    return settings;
}

/// Samples of a pass of few enough paths that it ends soon: there it can be saved, and ends near a
/// budget. A processor takes some seconds for them, a graphics processor less than one.
std::uint32_t samples_per_pass(const RenderSettings& settings, const DeviceInfo& device) {
    const std::uint64_t paths = device.lane_serial() ? 1u << 20 : 1u << 24;
    const CropRectangle part =
        settings.crop.value_or(CropRectangle{0, 0, settings.width, settings.height});
    const std::uint64_t pixels =
        static_cast<std::uint64_t>(part.width()) * static_cast<std::uint64_t>(part.height());
    return static_cast<std::uint32_t>(std::max<std::uint64_t>(paths / pixels, 1));
}

/// What a user who watches the passes of a picture is told.
class Watched {
public:
    /// law: of a progressive picture, of which the error is estimated; none: it is not.
    Watched(Session& session, const std::optional<ErrorLaw>& law) : session_(session), law_(law) {}

    /// Call before the first pass, and after each one.
    void between_passes() {
        if (!law_) {
            return;
        }
        if (!error_) {
            error_.emplace(*law_, session_.passes());
        }
        if (session_.passes() == error_->next()) {
            error_->add(session_.layers());
        }
    }

    std::string describe() const {
        const std::optional<double> error =
            error_ ? error_->after(session_.passes()) : std::nullopt;
        return error ? fmt::format("{}, error about {:.2g}", session_.describe(), *error)
                     : session_.describe();
    }

private:
    Session& session_;
    std::optional<ErrorLaw> law_;
    std::optional<RunningError> error_;
};

/// Begins the image of a job, or goes on with a saved one.
void begin_or_resume(RenderJob& job, const CheckpointKey& key, std::vector<std::string>& notes) {
    const RenderOptions& options = job.options;
    Session& session = *job.session;
    if (options.resume.empty()) {
        session.begin_frame(job.settings.seed);
        return;
    }
    const LoadedCheckpoint loaded = load_checkpoint(options.resume, key);
    if (!options.checkpoint.empty()) {
        check_checkpoints_replaced(options.checkpoint, key);
    }
    session.resume(loaded.state, job.settings.seed);
    if (loaded.note) {
        notes.push_back(*loaded.note);
    }
    if (session.share(0) > 1) {
        notes.push_back(fmt::format("'{}' holds {} passes, more than --passes asks for; the "
                                    "picture has all of them",
                                    options.resume, session.passes()));
    }
}

/// Renders an image, or the rest of one, and saves checkpoints and pictures on the way. An
/// interrupted render ends with a whole pass, which is saved.
RenderResult render_and_save(RenderJob& job, const OnProgress& on_progress, Watched& watched,
                             std::vector<std::string>& notes) {
    const RenderOptions& options = job.options;
    Session& session = *job.session;
    const MethodInfo& method = options.methods.at(job.settings.method);
    const CheckpointKey key = checkpoint_key(job.scene, job.settings, method, job.device->info());
    begin_or_resume(job, key, notes);
    bool can_save = !options.checkpoint.empty();
    bool has_saved = false;
    bool can_show = is_progressive(method, job.settings); // such a render may have no end
    const auto save = [&] {
        try {
            save_checkpoint(options.checkpoint, key, session.save());
            has_saved = true;
        } catch (const DeviceFault&) {
            throw;
        } catch (const Error& error) { // such as a full disk: the picture is worth more
            can_save = false;
            notes.push_back(fmt::format("{}; there are no more checkpoints", error.what()));
        }
    };
    const auto show = [&] {
        try {
            const std::vector<Layer> layers = session.layers();
            const PictureSettings file =
                picture_settings(options.picture, job.settings, whole_picture(layers));
            for (const std::string& output : options.outputs) {
                write_image(output, layers, file);
            }
        } catch (const DeviceFault&) {
            throw;
        } catch (const Error& error) { // the end writes it again
            can_show = false;
            notes.push_back(fmt::format("{}; the picture appears at the end", error.what()));
        }
    };
    std::uint64_t saved = session.passes();
    Clock::time_point last = Clock::now();
    bool stopped = false;
    RenderResult result = finish(
        session,
        [&](double done) {
            on_progress(done);
            return true;
        },
        [&](const PictureSoFar& so_far) {
            watched.between_passes();
            std::optional<PassPlan> plan = session.next_pass();
            stopped = plan && interrupted();
            if (stopped) {
                plan.reset();
            }
            if (so_far.passes > saved && (!plan || seconds_since(last) >= options.every)) {
                if (can_save) {
                    save();
                }
                if (plan && can_show) {
                    show();
                }
                saved = so_far.passes;
                last = Clock::now();
            }
            return plan;
        });
    result.statistics.interrupted = stopped;
    if (stopped && has_saved) {
        notes.push_back(fmt::format("--resume {} goes on with it", options.checkpoint));
    }
    return result;
}

RenderResult render_image(RenderJob& job, const OnProgress& on_progress, Watched& watched) {
    if (job.shutter) {
        return render_through(*job.session, *job.world, job.scene, *job.shutter, job.settings.seed,
                              on_progress);
    }
    if (!job.session->is_current(job.settings.seed)) {
        job.session->begin_frame(job.settings.seed);
    }
    return finish(*job.session, on_progress, [&](const PictureSoFar&) {
        watched.between_passes();
        return job.session->next_pass();
    });
}

Rendered render_on(RenderJob& job, const std::string& work) {
    const RenderOptions& options = job.options;
    if (!job.world) {
        const Clock::time_point start = Clock::now();
        job.world = std::make_unique<World>(*job.device, job.scene, options.tracer);
        job.times.upload = seconds_since(start);
    }
    World& world = *job.world;
    std::optional<Progress> progress;
    std::optional<Watched> watched;
    const OnProgress on_progress = [&](double done) {
        if (watched) {
            // With --budget, time decides, not the passes that are expected.
            progress->update(job.settings.budget ? job.session->share(0) : done,
                             watched->describe());
        } else {
            progress->update(done);
        }
        return !interrupted();
    };
    if (!is_autotuned(options, job.command)) {
        progress.emplace(work, options.quiet);
        if (!job.session) {
            job.session =
                std::make_unique<Session>(world, job.scene, job.settings, options.methods);
        }
        const MethodInfo& method = options.methods.at(job.settings.method);
        watched.emplace(*job.session, progress->is_shown() && is_progressive(method, job.settings)
                                          ? std::optional(law_of(method, job.settings))
                                          : std::nullopt);
        if (has_checkpoints(options) || is_given(job.command, "--every")) {
            Rendered rendered{.result = {}, .settings = job.settings, .tuned = {}, .notes = {}};
            rendered.result = render_and_save(job, on_progress, *watched, rendered.notes);
            return rendered;
        }
        return {.result = render_image(job, on_progress, *watched),
                .settings = job.settings,
                .tuned = {},
                .notes = {}};
    }
    // How long pilots take shows only as they run.
    progress.emplace("trying methods", options.quiet);
    bool picked_one = false;
    const Target target{.error = options.target_error,
                        .seconds = options.settings.budget,
                        .methods = options.methods};
    const UserSet user_set{.method = is_given(job.command, "--method"),
                           .samples = is_given(job.command, "--spp"),
                           .photons = is_given(job.command, "--photons")};
    const RenderPasses passes = [&](const RenderSettings& settings, const OnPass& on_pass) {
        return render(
            world, job.scene, settings,
            [&](double done) { return on_progress(picked_one ? done : 0); }, on_pass,
            options.methods);
    };
    AutotunedRender tuned = autotune(
        passes, job.scene, job.settings, user_set, target, [&](const AutotunedRender& picked) {
            progress.reset();
            if (!options.quiet) {
                fmt::print(stderr, "argand: picked {}\n", describe_pick(picked));
            }
            progress.emplace(work, options.quiet);
            picked_one = true;
        });
    Rendered rendered{
        .result = std::move(tuned.result), .settings = tuned.settings, .tuned = {}, .notes = {}};
    rendered.settings.budget = target.seconds;
    rendered.tuned = std::move(tuned);
    return rendered;
}

/// Notes for the user on a render that took this time.
std::vector<std::string> notes_on(const Rendered& rendered, MethodTable methods, double seconds) {
    constexpr double clearly_more = 1.2;
    const RenderSettings& settings = rendered.settings;
    const std::uint64_t passes = rendered.result.statistics.passes;
    std::vector<std::string> notes;
    if (rendered.tuned) {
        notes.push_back(describe_outcome(*rendered.tuned));
    }
    if (const std::uint32_t times = rendered.result.statistics.texture_halvings; times > 0) {
        notes.push_back(fmt::format("textures exceed what the device can hold: the largest are "
                                    "reduced to 1/{} of their sides",
                                    std::uint64_t{1} << times));
    }
    if (const glm::ivec2 size = rendered.result.statistics.reduced_sky; size.x > 0) {
        notes.push_back(fmt::format("the sky's picture exceeds what the device can hold: it is "
                                    "reduced to {} × {} texels",
                                    size.x, size.y));
    }
    if (settings.budget && seconds > clearly_more * *settings.budget) {
        notes.push_back(fmt::format(
            "rendering took {:.3g} s in {} pass{}, not the {:.3g} s of "
            "--budget; passes are shorter "
            "with a lower --spp{}",
            seconds, passes, passes == 1 ? "" : "es", *settings.budget,
            methods.at(settings.method).option("photons") ? " or fewer --photons" : ""));
    }
    return notes;
}

/// Prints them, unless --quiet is given.
void print_notes(const RenderOptions& options, const std::vector<std::string>& notes) {
    for (const std::string& note : notes) {
        if (!options.quiet) {
            fmt::print(stderr, "argand: note: {}\n", note);
        }
    }
}

} // namespace

bool has_checkpoints(const RenderOptions& options) {
    return !options.checkpoint.empty() || !options.resume.empty();
}

bool is_autotuned(const RenderOptions& options, const CLI::App& command) {
    return options.target_error || (options.settings.budget && !is_given(command, "--method"));
}

RenderJob open_job(const RenderOptions& options, const CLI::App& command,
                   std::optional<double> seconds) {
    RenderJob job{.options = options,
                  .command = command,
                  .settings = options.settings,
                  .scene = {},
                  .device = nullptr,
                  .world = nullptr,
                  .session = nullptr,
                  .shutter = {},
                  .times = {}};
    const PictureSize size = parse_picture_size(options.size);
    job.settings.width = size.width;
    job.settings.height = size.height;
    job.settings.crop = parse_crop(options.picture.crop, size);
    const Clock::time_point start = Clock::now();
    job.scene = load_scene(options, seconds);
    job.times.load = seconds_since(start);
    check_overwrites_no_file_of(job.scene, options.outputs);
    check_overwrites_no_file_of(job.scene, {options.report});
    job.settings.camera = find_camera(job.scene, options.camera);
    choose_method(job.settings, options, command, job.scene);
    if (!options.shutter.empty()) {
        job.settings = with_pass_per_sample(job.settings);
    }
    if (options.picture.layers.variance) {
        job.settings = with_variance(job.settings);
    }
    print_notes(options, job.scene.notes);
    const Clock::time_point opened = Clock::now();
    job.device = open_backend(options.backend, options.device, options.quiet);
    job.times.open = seconds_since(opened);
    if (!is_autotuned(options, command)) {
        job.settings.samples_per_pass = samples_per_pass(job.settings, job.device->info());
    }
    return job;
}

Rendered render_picture(RenderJob& job, const std::string& work) {
    const RenderOptions& options = job.options;
    Clock::time_point start = Clock::now();
    Rendered rendered;
    try {
        if (job.world) {
            job.world->update(job.scene);
            job.times.update += seconds_since(start);
            start = Clock::now();
        }
        rendered = render_on(job, work);
    } catch (const DeviceFault& fault) {
        if (has_checkpoints(options)) {
            throw; // they are this device's
        }
        job.session.reset();
        job.world.reset();
        job.device = open_after_fault(options.backend, options.device, fault);
        start = Clock::now();
        rendered = render_on(job, work);
    }
    for (Layer& layer :
         render_features(*job.world, job.scene, rendered.settings, options.picture.layers)) {
        rendered.result.layers.push_back(std::move(layer));
    }
    job.times.render = seconds_since(start);
    const KdTree& kdtree = job.world->tree().kdtree;
    if (kdtree.stopped) {
        rendered.notes.push_back(fmt::format("the kd-tree has only {} leaves, as more would exceed "
                                             "--tree-memory {}; rays are slower",
                                             kdtree.leaf_count, options.tracer.tree_memory));
    }
    for (std::string& note : notes_on(rendered, options.methods, job.times.render)) {
        rendered.notes.push_back(std::move(note));
    }
    if (options.picture.automatic) {
        rendered.notes.push_back(fmt::format("--exposure auto is {:.2f} stops for this picture",
                                             file_settings(job, rendered).display.exposure_ev));
    }
    return rendered;
}

PictureSettings file_settings(const RenderJob& job, const Rendered& rendered) {
    return picture_settings(job.options.picture, job.settings,
                            whole_picture(rendered.result.layers));
}

void write_picture(RenderJob& job, const Rendered& rendered,
                   const std::vector<std::string>& outputs) {
    const Clock::time_point start = Clock::now();
    const PictureSettings file = file_settings(job, rendered);
    for (const std::string& output : outputs) {
        write_image(output, rendered.result.layers, file);
    }
    job.times.write = seconds_since(start);
}

nlohmann::ordered_json report_on(const RenderJob& job, const Rendered& rendered,
                                 const std::vector<std::string>& outputs) {
    nlohmann::ordered_json report =
        render_report({.device = *job.device,
                       .scene = job.scene,
                       .method = job.options.methods.at(rendered.settings.method),
                       .settings = rendered.settings,
                       .display = file_settings(job, rendered).display,
                       .outputs = outputs,
                       .statistics = rendered.result.statistics,
                       .times = job.times});
    for (const std::string& note : rendered.notes) {
        report["notes"].push_back(note);
    }
    if (job.options.picture.layers.id) {
        for (const SceneObject& object : job.scene.objects) {
            report["objects"].push_back({{"id", object.node + 1}, {"name", object.name}});
        }
    }
    if (job.options.tracer.kdtree) {
        const KdTree& tree = job.world->tree().kdtree;
        report["kdtree"] = {{"leaves", tree.leaf_count},
                            {"references", tree.references},
                            {"bytes", kd_tree_bytes(tree.leaf_count, tree.references)},
                            {"stopped", tree.stopped}};
    }
    if (rendered.tuned) {
        report["aim"] = autotune_report(*rendered.tuned, job.options.methods);
    }
    return report;
}

void tell_of(const RenderJob& job, const Rendered& rendered,
             const std::vector<std::string>& outputs, double seconds) {
    const RenderStatistics& statistics = rendered.result.statistics;
    if (statistics.non_finite > 0) {
        fmt::print(
            stderr,
            "argand: note: {} samples were not finite and are left out; please report the scene\n",
            statistics.non_finite);
    }
    print_notes(job.options, rendered.notes);
    if (!job.options.quiet) {
        const Image& picture = whole_picture(rendered.result.layers);
        fmt::print("{}: {} {}x{} on {} in {:.2f} s{}\n", fmt::join(outputs, ", "),
                   rendered.settings.method, picture.width, picture.height, job.device->info().name,
                   seconds, statistics.interrupted ? " (interrupted: the passes so far)" : "");
    }
}

} // namespace argand
