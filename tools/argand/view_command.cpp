#include "commands.hpp"

#include "backend_options.hpp"
#include "base/atomic_write.hpp"
#include "base/error.hpp"
#include "base/interrupt.hpp"
#include "base/json.hpp"
#include "base/median.hpp"
#include "base/progress.hpp"
#include "image/files.hpp"
#include "interactive/run_script.hpp"
#include "method_options.hpp"
#include "methods/plan_render.hpp"
#include "numbers.hpp"
#include "overwriting.hpp"
#include "picture_options.hpp"
#include "picture_size.hpp"
#include "scene_options.hpp"

#include <algorithm>
#include <filesystem>
#include <memory>
#include <unistd.h>
#include <utility>

namespace argand {

namespace {

struct ViewOptions : SceneOptions {
    MethodTable methods;
    std::string size = "512x512";
    std::string camera, backend = "auto", device, report, script;
    PictureOptions picture;
    double frame_seconds = 0.1;
    bool headless = false, quiet = false;
    RenderSettings settings;
};

/// Throws UsageError or Error, before any work, on what could not be written or must not be.
void check_outputs(const ViewOptions& options, const Script& script) {
    std::vector<std::string> inputs{options.scene};
    for (const std::string& file : {options.script, options.edits, options.env}) {
        if (!file.empty()) {
            inputs.push_back(file);
        }
    }
    for (const ScriptEvent& event : script.events) {
        if (event.open) {
            inputs.push_back(*event.open);
        }
    }
    for (const ScriptEvent& event : script.events) {
        if (event.screenshot) {
            check_overwrites_none(*event.screenshot, inputs);
            check_image_writable(*event.screenshot);
        }
        if (event.save_edits) {
            check_overwrites_none(*event.save_edits, inputs);
            check_writable(*event.save_edits);
        }
    }
    if (!options.report.empty()) {
        check_overwrites_none(options.report, inputs);
        check_writable(options.report);
    }
}

/// The settings of the view of a scene. Picks the method where the user has not.
ViewSettings view_settings(const ViewOptions& options, const CLI::App& command,
                           const Scene& scene) {
    ViewSettings settings{.still = options.settings, .frame_seconds = options.frame_seconds};
    const PictureSize size = parse_picture_size(options.size);
    settings.still.width = size.width;
    settings.still.height = size.height;
    settings.still.camera = find_camera(scene, options.camera);
    if (!is_given(command, "--method")) {
        settings.still.method = method_for(scene, options.settings, options.methods).name;
    }
    check_method_options(command, options.methods.at(settings.still.method), options.methods);
    if (!is_given(command, "--spp")) {
        settings.still.samples = 1;
    }
    if (is_given(command, "--passes")) {
        settings.passes = options.settings.progressive.passes;
    }
    return settings;
}

/// The command that renders the picture at rest as it is now. edits: the file that holds the
/// view's.
std::string equivalent_command(const View& view, const ViewOptions& options,
                               const std::string& edits, const PictureOptions& picture) {
    const RenderSettings settings = view.equivalent();
    std::vector<std::string> words{"argand",
                                   "render",
                                   view.file(),
                                   "--method",
                                   settings.method,
                                   "--size",
                                   fmt::format("{}x{}", settings.width, settings.height)};
    const auto add = [&](const std::string& option, const std::string& value) {
        words.push_back("--" + option);
        words.push_back(value);
    };
    if (!view.edits().empty()) {
        add("edits", edits);
    }
    if (view.time()) {
        add("at", fmt::format("{}", *view.time()));
    }
    if (settings.camera != 0) {
        add("camera", std::to_string(settings.camera));
    }
    if (settings.seed != 0) {
        add("seed", std::to_string(settings.seed));
    }
    for (const auto& [option, value] :
         {std::pair{"env", options.env}, {"sun", options.sun}, {"scene", options.load.scene}}) {
        if (!value.empty()) {
            add(option, value);
        }
    }
    if (options.load.allow_external) {
        words.emplace_back("--allow-external");
    }
    if (options.load.grey_for_missing) {
        add("missing-textures", "grey");
    }
    if (picture.automatic) {
        add("exposure", "auto");
    } else if (picture.exposure != 0) {
        add("exposure", fmt::format("{}", picture.exposure));
    }
    if (picture.tone != Tone::linear) {
        add("tone", std::string(name_of(picture.tone)));
    }
    for (const auto& [option, value] :
         {std::pair{"env-rotation", options.rotation}, {"env-strength", options.strength}}) {
        if (value) {
            add(option, fmt::format("{}", *value));
        }
    }
    const RenderSettings usual;
    for (const Option& option : options.methods.at(settings.method).options) {
        const std::string value = option.get(settings);
        if (value != option.get(usual)) {
            words.push_back("--" + option.name);
            if (option.kind != OptionKind::flag) {
                words.push_back(value);
            }
        }
    }
    std::vector<const char*> arguments;
    for (const std::string& word : words) {
        arguments.push_back(word.c_str());
    }
    return command_text(static_cast<int>(arguments.size()), arguments.data());
}

/// The file that holds the view's edits as they are now: one that the script wrote, or that was
/// given. "EDITS.json" if there is none.
std::string file_of_edits(const View& view, const ViewOptions& options, const Script& script) {
    std::vector<std::string> files{options.edits};
    for (const ScriptEvent& event : script.events) {
        files.push_back(event.save_edits.value_or(""));
    }
    const auto found = std::find_if(files.rbegin(), files.rend(), [&](const std::string& file) {
        return !file.empty() && read_json(file) == view.edits();
    });
    return found == files.rend() ? "EDITS.json" : *found;
}

nlohmann::ordered_json frame_json(const ViewFrame& frame, const std::string& error) {
    nlohmann::ordered_json json{{"frame", frame.number},   {"moving", frame.moving},
                                {"passes", frame.passes},  {"width", frame.width},
                                {"height", frame.height},  {"photons", frame.photons},
                                {"seconds", frame.seconds}};
    if (!error.empty()) {
        json["error"] = error;
    }
    return json;
}

/// What a session was like.
class Summary {
public:
    void add(const ViewFrame& frame, const std::string& error) {
        frames_.push_back(frame);
        json_ += json_text(frame_json(frame, error), one_line_of_json);
    }

    std::uint64_t frames() const { return frames_.size(); }
    const std::string& json() const { return json_; }

    std::string text() const {
        std::vector<double> previews;
        for (const ViewFrame& frame : frames_) {
            if (frame.moving) {
                previews.push_back(frame.seconds);
            }
        }
        std::string text = fmt::format("{} frames", frames_.size());
        if (!previews.empty()) {
            text += fmt::format(", {} of them previews of {:.0f} ms (median)", previews.size(),
                                1e3 * median(previews));
        }
        if (!frames_.empty() && !frames_.back().moving) {
            text += fmt::format(", {} passes at rest", frames_.back().passes);
        }
        return text;
    }

private:
    std::vector<ViewFrame> frames_;
    std::string json_;
};

/// Goes on as the program with a window. Returns only by an Error.
[[noreturn]] void start_window_program(std::span<const char* const> arguments) {
    std::error_code problem;
    const std::filesystem::path program =
        std::filesystem::read_symlink("/proc/self/exe", problem).parent_path() / "argand-view";
    if (!problem && std::filesystem::exists(program)) {
        std::vector<std::string> words(arguments.begin(), arguments.end());
        words.erase(std::find(words.begin(), words.end(), "view"));
        std::vector<char*> pointers;
        for (std::string& word : words) {
            pointers.push_back(word.data());
        }
        pointers.push_back(nullptr);
        execv(program.c_str(), pointers.data()); // returns only if it fails
    }
    fail("opening a window: there is no program '{}', which is built where GLFW (libglfw3-dev) and "
         "Dear ImGui (libimgui-dev) are installed; use --headless with --script FILE",
         program.string());
}

/// Runs a script without a window.
void run_headless(View& view, const ViewOptions& options, const Script& script, Summary& summary) {
    Progress progress("viewing", options.quiet);
    run_script(view, script,
               {.screenshot =
                    [&](View& shown, const std::string& file) {
                        write_image(
                            file, shown.layers(),
                            picture_settings(options.picture, shown.settings(), shown.picture()));
                    },
                .on_frame =
                    [&](const ViewFrame& frame, const std::string& error) {
                        summary.add(frame, error);
                        if (!error.empty() && !options.quiet) {
                            progress.erase();
                            fmt::print(stderr, "argand: frame {}: {}\n", frame.number, error);
                        }
                        progress.update(static_cast<double>(frame.number + 1) /
                                        static_cast<double>(script.frames));
                    },
                .stops = interrupted});
}

void run(const ViewOptions& options, const CLI::App& command,
         std::span<const char* const> arguments, ShowInWindow window) {
    if (options.headless && options.script.empty()) {
        throw UsageError("viewing with --headless: nobody would see it; give --script FILE, what "
                         "happens at which frame");
    }
    check_methods({options.settings.method}, options.methods);
    std::optional<Script> script;
    if (!options.script.empty()) {
        script = parse_script(read_json(options.script), options.script);
    }
    check_outputs(options, script.value_or(Script()));
    if (!options.headless && window == nullptr) {
        start_window_program(arguments);
    }
    catch_interrupts();
    SceneOptions unedited = options;
    unedited.edits.clear();
    const View::Load load = [&](const std::string& file, std::optional<double> seconds,
                                bool movable_nodes) {
        SceneOptions of_file = unedited;
        of_file.scene = file;
        of_file.load.movable_nodes = movable_nodes;
        return load_scene(of_file, seconds);
    };
    Scene scene = load(options.scene, options.seconds, false);
    for (const std::string& note : scene.notes) {
        if (!options.quiet) {
            fmt::print(stderr, "argand: note: {}\n", note);
        }
    }
    const ViewSettings settings = view_settings(options, command, scene);
    const std::unique_ptr<Device> device =
        open_backend(options.backend, options.device, options.quiet);
    View view(*device, std::move(scene), options.scene, load, settings, options.methods);
    if (!options.edits.empty()) {
        view.set_edits(read_json(options.edits));
    }
    Summary summary;
    const auto report = [&] {
        if (!options.report.empty()) {
            write_atomically(options.report, summary.json());
        }
    };
    try {
        if (options.headless) {
            run_headless(view, options, *script, summary);
        } else {
            window(view, {.picture = options.picture,
                          .script = script,
                          .command =
                              [&](const View& shown, const std::string& edits,
                                  const PictureOptions& picture) {
                                  return equivalent_command(shown, options, edits, picture);
                              },
                          .on_frame =
                              [&](const ViewFrame& frame, const std::string& error) {
                                  if (script || !options.report.empty()) {
                                      summary.add(frame, error);
                                  }
                              }});
        }
    } catch (...) {
        report(); // tells what led there
        throw;
    }
    report();
    if (script && summary.frames() < script->frames) {
        fail("viewing '{}': interrupted after {} of {} frames; the script is not at its end",
             options.scene, summary.frames(), script->frames);
    }
    if (script && !options.quiet) {
        fmt::print("{}: {}\n{}\n", options.scene, summary.text(),
                   equivalent_command(view, options, file_of_edits(view, options, *script),
                                      options.picture));
    }
}

} // namespace

void add_view_command(CLI::App& app, MethodTable methods, std::span<const char* const> arguments,
                      ShowInWindow window) {
    CLI::App* command = app.add_subcommand(
        "view", "Look at a scene and change it: a preview while anything moves, then refinement");
    auto options = std::make_shared<ViewOptions>(ViewOptions{SceneOptions(), methods});
    options->picture.command = command_text(static_cast<int>(arguments.size()), arguments.data());
    options->settings.method = methods.begin()->name;
    add_scene_options(*command, *options);
    command->add_flag("--headless", options->headless,
                      "Without a window: runs --script, as fast as it can");
    command->add_option("--script", options->script,
                        "JSON file of what happens at which frame; see docs/view.md");
    command->add_option("--method", options->settings.method,
                        fmt::format("{}; see `argand render --help` (default: the one that render "
                                    "takes for the scene)",
                                    fmt::join(methods.names(), ", ")));
    command->add_option("--size", options->size, "Width x height in pixels")->capture_default_str();
    command
        ->add_option("--frame-time", options->frame_seconds,
                     "Seconds that a frame is to take while anything moves: the preview's pixels "
                     "and photons are chosen for it")
        ->capture_default_str()
        ->check(number_between(1e-3, 100));
    add_method_options(*command, options->settings, methods);
    command->add_option("--seed", options->settings.seed, "Seed of the random numbers")
        ->capture_default_str()
        ->check(integer_between(0, 0xffffffff));
    command->add_option("--camera", options->camera,
                        "Name or index of the camera (default: the first)");
    add_display_options(*command, options->picture);
    add_backend_options(*command, options->backend, options->device);
    command->add_option("--json", options->report,
                        "Write a line of JSON for each frame to this file");
    command->add_flag("-q,--quiet", options->quiet, "Print errors only");
    command->footer("Examples:\n  argand view assets/cornell_area.glb\n"
                    "  argand view assets/cornell_area.glb --headless --script "
                    "docs/view_script.json");
    command->callback(
        [options, command, arguments, window] { run(*options, *command, arguments, window); });
}

} // namespace argand
