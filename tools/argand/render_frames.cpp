#include "render_frames.hpp"

#include "base/atomic_write.hpp"
#include "base/clock.hpp"
#include "base/error.hpp"
#include "base/interrupt.hpp"
#include "frame_outputs.hpp"
#include "frame_reports.hpp"
#include "frames.hpp"
#include "image/files.hpp"
#include "method_options.hpp"
#include "overwriting.hpp"
#include "scene/pose.hpp"

#include <vector>

namespace argand {

void check_frames(const RenderOptions& options, const CLI::App& command) {
    if (options.frames.empty()) {
        for (const char* option :
             {"--fps", "--seed-per-frame", "--continue", "--keep", "--shutter"}) {
            if (is_given(command, option)) {
                throw UsageError(
                    fmt::format("reading {}: it needs --frames A:B, the frames to render", option));
            }
        }
        return;
    }
    parse_frame_range(options.frames);
    if (!options.shutter.empty()) {
        parse_shutter(options.shutter);
        if (is_autotuned(options, command)) {
            throw UsageError("reading --shutter: its passes see different moments, which "
                             "--target-error, and --budget without --method, would take for "
                             "noise; leave one of the two out");
        }
    }
    if (options.seconds) {
        throw UsageError("reading --at: with --frames, frame k is at k / --fps seconds; leave one "
                         "of the two out");
    }
    if (options.picture.automatic) {
        throw UsageError("reading --exposure auto: with --frames each frame would have an exposure "
                         "of its own, and the film would flicker; give stops");
    }
    for (const std::string& output : options.outputs) {
        if (!is_film(output)) {
            check_frame_pattern(output);
        } else if (options.continues) {
            throw UsageError(fmt::format("reading --continue: the film '{}' cannot be continued; "
                                         "write frame_%04d.png and --continue those",
                                         output));
        }
    }
}

void check_output(const RenderOptions& options, const std::string& output) {
    if (options.frames.empty() && is_film(output)) {
        throw UsageError(fmt::format("cannot write '{}': the extension '{}' is not that of a known "
                                     "picture format; use .exr or .png, or --frames A:B for a film",
                                     output, lower_extension(output)));
    }
    if (options.frames.empty()) {
        check_image_writable(output);
    } else if (is_film(output)) {
        check_writable(output);
    } else {
        check_image_writable(frame_name(output, parse_frame_range(options.frames).first));
    }
}

void render_frames(const RenderOptions& options, const CLI::App& command) {
    const FrameRange range = parse_frame_range(options.frames);
    const auto seconds_of = [&](std::uint64_t frame) {
        return static_cast<double>(frame) / options.frames_per_second;
    };
    const bool blurs = !options.shutter.empty();
    const Shutter shares = blurs ? parse_shutter(options.shutter) : Shutter();
    FrameOutputs files(options);
    FrameReports reports(options.report, options.continues);
    std::vector<bool> done(range.end - range.first, false);
    for (std::uint64_t frame = range.first; options.continues && frame < range.end; ++frame) {
        done[frame - range.first] = files.has(frame);
    }
    RenderJob job = open_job(options, command, seconds_of(range.first));
    for (std::uint64_t frame = range.first; frame < range.end; ++frame) {
        const std::vector<std::string> outputs = files.names(frame);
        if (done[frame - range.first]) {
            continue;
        }
        check_overwrites_no_file_of(job.scene, outputs);
        const Clock::time_point start = Clock::now();
        job.device->reset_stage_times();
        move_without_vertices(seconds_of(frame), job.scene);
        job.times.update = seconds_since(start);
        if (blurs) {
            const auto first = static_cast<double>(frame);
            job.shutter = {(first + shares.open) / options.frames_per_second,
                           (first + shares.close) / options.frames_per_second};
        }
        if (options.seed_per_frame) {
            job.settings.seed = options.settings.seed + static_cast<std::uint32_t>(frame);
        }
        const Rendered rendered =
            render_picture(job, fmt::format("frame {} of {}", frame, options.frames));
        // The signal may have ended the work of a witness, and left the picture itself whole.
        if (rendered.result.statistics.interrupted || interrupted()) {
            fail("rendering '{}': interrupted in frame {}, which is not written; {}", options.scene,
                 frame,
                 files.has_films() ? "nor are films, which --continue cannot resume: for that, "
                                     "write frame_%04d.png"
                                   : "--continue resumes there");
        }
        files.write(job, rendered, frame);
        nlohmann::ordered_json report{{"frame", frame}};
        report.update(report_on(job, rendered, outputs));
        report["tree_cost"] = job.world->tree_cost();
        report["parameters"].update({{"fps", options.frames_per_second},
                                     {"seed_per_frame", options.seed_per_frame},
                                     {"keep", options.keep}});
        if (blurs) {
            report["parameters"]["at"] = seconds_of(frame);
            report["parameters"]["shutter"] = {job.shutter->open, job.shutter->close};
        }
        reports.add(report);
        tell_of(job, rendered, files.names_to_tell(frame), seconds_since(start));
        job.times.load = job.times.open = job.times.upload = 0; // they are the first frame's
        if (options.keep == "none") {
            job.session.reset();
        }
    }
    files.finish();
}

} // namespace argand
