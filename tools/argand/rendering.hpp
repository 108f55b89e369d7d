#pragma once

#include "autotune/autotune.hpp"
#include "picture_options.hpp"
#include "report.hpp"
#include "scene_options.hpp"
#include "session/shutter.hpp"
#include "world/world.hpp"

#include <CLI/CLI.hpp>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace argand {

/// What the user asked `argand render` for.
struct RenderOptions : SceneOptions {
    MethodTable methods;
    std::vector<std::string> outputs;
    std::string size = "512x512";
    std::string camera;
    std::string backend = "auto";
    std::string device;
    std::string report;
    PictureOptions picture;
    bool quiet = false;
    std::optional<double> target_error;
    std::string frames; ///< "A:B"; empty: one picture
    double frames_per_second = 24;
    bool seed_per_frame = false, continues = false;
    std::string shutter;            ///< "OPEN:CLOSE"; empty: a frame sees its moment only
    std::string keep = "all";       ///< of a frame's memory for the next one: "all" or "none"
    std::string checkpoint, resume; ///< files; empty: none
    double every = 300;             ///< seconds between checkpoints
    TracerSettings tracer;
    RenderSettings settings;

    const MethodInfo& method() const { return methods.at(settings.method); }
};

/// Whether Argand is to choose the method or the numbers of photons and samples.
bool is_autotuned(const RenderOptions& options, const CLI::App& command);

/// Whether the render saves checkpoints or goes on from one.
bool has_checkpoints(const RenderOptions& options);

/// What all pictures of a command share.
struct RenderJob {
    const RenderOptions& options;
    const CLI::App& command;
    RenderSettings settings; ///< those of the options, but for what the scene decides
    Scene scene;
    std::unique_ptr<Device> device;
    std::unique_ptr<World> world;     ///< on the device; null before the first picture
    std::unique_ptr<Session> session; ///< in this world; null before the first picture, and where
                                      ///< pictures share nothing
    std::optional<Shutter> shutter;   ///< of the next picture; none: it sees the scene as it is
    ReportTimes times;                ///< of the last picture
};

/// Loads the scene at a time of its animations (none: at rest), chooses what the scene decides, and
/// opens the device. Prints the scene's notes.
RenderJob open_job(const RenderOptions& options, const CLI::App& command,
                   std::optional<double> seconds);

/// A rendered picture.
struct Rendered {
    RenderResult result;
    RenderSettings settings;              ///< with what autotuning chose
    std::optional<AutotunedRender> tuned; ///< how it chose, if it did
    std::vector<std::string> notes;       ///< for the user
};

/// Renders the scene as it is, in a world that follows it; adds the time for that to
/// job.times.update. work: shown while it runs.
Rendered render_picture(RenderJob& job, const std::string& work);

/// How the files of a picture are to be written.
PictureSettings file_settings(const RenderJob& job, const Rendered& rendered);

/// Writes the picture to each output.
void write_picture(RenderJob& job, const Rendered& rendered,
                   const std::vector<std::string>& outputs);

/// The report of a picture that is written.
nlohmann::ordered_json report_on(const RenderJob& job, const Rendered& rendered,
                                 const std::vector<std::string>& outputs);

/// Prints a line on the written picture, and its notes, unless --quiet is given.
void tell_of(const RenderJob& job, const Rendered& rendered,
             const std::vector<std::string>& outputs, double seconds);

} // namespace argand
