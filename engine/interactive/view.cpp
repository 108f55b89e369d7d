#include "interactive/view.hpp"

#include "base/clock.hpp"
#include "base/error.hpp"
#include "base/interrupt.hpp"
#include "interactive/upsample.hpp"
#include "scene/solids.hpp"
#include "session/render.hpp"
#include "world/world.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>
#include <utility>

namespace argand {

namespace {

/// Device seconds since reset_stage_times(), or, on a device without time stamps, a guess from
/// those that passed.
PreviewTime time_of(Device& device, double seconds, bool has_photons) {
    constexpr std::array<std::string_view, 8> of_pixels{
        "camera rays", "trace eye rays", "trace shadow rays", "shade",
        "film",        "gather photons", "share queries",     "compact"};
    PreviewTime time;
    if (!device.info().features.timestamps) {
        time.pixels = has_photons ? 0.6 * seconds : seconds;
        time.photons = seconds - time.pixels;
        return time;
    }
    for (const StageTime& stage : device.stage_times()) {
        const bool is_of_pixels =
            std::find(of_pixels.begin(), of_pixels.end(), stage.name) != of_pixels.end();
        (is_of_pixels ? time.pixels : has_photons ? time.photons : time.rest) += stage.seconds;
    }
    time.rest += std::max(seconds - time.photons - time.pixels - time.rest, 0.0);
    return time;
}

/// Throws UsageError unless the option takes the value.
void check_range(const Option& option, const std::string& value) {
    const auto complain = [&](const std::string& expected) {
        throw UsageError(
            fmt::format("setting {} to '{}': it is not {}", option.name, value, expected));
    };
    if (option.kind == OptionKind::choice) {
        if (std::find(option.choices.begin(), option.choices.end(), value) ==
            option.choices.end()) {
            complain(fmt::format("one of {}", fmt::join(option.choices, ", ")));
        }
    } else if (option.kind != OptionKind::flag && value != "auto") {
        double number = 0;
        read_value(option.name, value, number);
        if (!(number >= option.low && number <= option.high)) {
            complain(fmt::format("between {:.6g} and {:.6g}", option.low, option.high));
        }
    }
}

} // namespace

View::View(Device& device, Scene scene, const std::string& file, Load load,
           const ViewSettings& settings, MethodTable methods)
    : device_(device), load_(std::move(load)), settings_(settings), methods_(methods), file_(file) {
    methods_.at(settings_.still.method); // throws if there is none
    show(std::move(scene));
    restart_frame_time();
}

void View::show(Scene scene) {
    preview_.reset();
    still_.reset();
    world_.reset();
    scene_ = std::make_unique<Scene>(std::move(scene));
    editor_.emplace(*scene_);
    applied_ = {};
    shows_still_ = false;
    changed_ = true;
}

void View::apply(const Edits& edits) {
    try {
        editor_->apply(edits, *scene_);
    } catch (const Error&) {
        editor_->apply(applied_, *scene_);
        throw;
    }
    applied_ = edits;
    changed_ = true;
}

void View::open(const std::string& file) {
    const bool again = file == file_;
    Scene scene = load_(file, scene_->seconds, again && movable_nodes_);
    const Edits edits = again ? applied_ : Edits();
    SceneEditor editor(scene);
    editor.apply(edits, scene); // throws if the file has changed, and lacks what was edited
    editor.apply({}, scene);
    show(std::move(scene));
    apply(edits);
    if (!again) {
        file_ = file;
        movable_nodes_ = false;
        edits_ = nlohmann::json::object();
        settings_.still.camera = 0;
    }
}

void View::edit(const nlohmann::json& patch) {
    nlohmann::json merged = edits_;
    merged.merge_patch(patch);
    set_edits(std::move(merged));
}

void View::set_edits(nlohmann::json all) {
    const Edits edits = parse_edits(all, "edits");
    if (!edits.nodes.empty() && !movable_nodes_) {
        const Edits before = applied_;
        show(load_(file_, scene_->seconds, true));
        movable_nodes_ = true;
        apply(before);
    }
    apply(edits);
    edits_ = std::move(all);
}

void View::set_time(std::optional<double> seconds) {
    scene_->seconds = seconds;
    apply(applied_);
}

void View::change_settings(RenderSettings settings) {
    settings_.still = std::move(settings);
    preview_.reset();
    still_.reset();
    changed_ = true;
    restart_frame_time();
}

void View::set_method(const std::string& method) {
    methods_.at(method); // throws if there is none
    RenderSettings settings = settings_.still;
    settings.method = method;
    change_settings(std::move(settings));
}

void View::set_option(const std::string& name, const std::string& value) {
    const Option* option = methods_.at(settings_.still.method).option(name);
    if (!option) {
        throw UsageError(fmt::format("setting {}: method '{}' has no such option", name,
                                     settings_.still.method));
    }
    check_range(*option, value);
    RenderSettings settings = settings_.still;
    option->set(settings, value);
    change_settings(std::move(settings));
}

void View::resize(int width, int height) {
    RenderSettings settings = settings_.still;
    settings.width = width;
    settings.height = height;
    change_settings(std::move(settings));
}

bool View::has_photons() const {
    return methods_.at(settings_.still.method).option("photons") != nullptr;
}

bool View::is_progressive_method() const {
    const MethodInfo& method = methods_.at(settings_.still.method);
    return method.option("progressive") != nullptr || method.abilities.progressive;
}

void View::restart_frame_time() {
    const RenderSettings& still = settings_.still;
    const bool has_photons = this->has_photons() && still.photons > 0;
    PreviewLimits limits{.pixels = static_cast<std::uint64_t>(still.width) *
                                   static_cast<std::uint64_t>(still.height)};
    limits.most_photons = has_photons ? still.photons : 0;
    limits.least_photons = std::min(limits.least_photons, limits.most_photons);
    frame_time_.emplace(settings_.frame_seconds, limits);
}

RenderSettings View::repeated(std::uint32_t passes) const {
    RenderSettings settings = settings_.still;
    if (is_progressive_method()) {
        settings.progressive.on = true;
        settings.progressive.passes = passes;
    } else if (!has_photons()) {
        settings.samples *= passes;
    }
    return settings;
}

RenderSettings View::equivalent() const {
    return repeated(static_cast<std::uint32_t>(std::max<std::uint64_t>(still_passes_, 1)));
}

void View::follow_scene() {
    if (world_ && known_solid_ranks(*scene_).materials != world_->surfaces().solids.materials) {
        preview_.reset();
        still_.reset();
        world_.reset();
    }
    if (world_) {
        world_->update(*scene_);
    } else {
        world_ = std::make_unique<World>(device_, *scene_);
    }
}

void View::preview(ViewFrame& frame) {
    const PreviewSize size = frame_time_->next();
    RenderSettings settings = settings_.still;
    const auto scaled = [&](int side) {
        return std::max(static_cast<int>(std::ceil(side * size.scale)), 1);
    };
    settings.width = scaled(settings.width);
    settings.height = scaled(settings.height);
    settings.samples = 1;
    if (size.photons > 0) {
        settings.photons = size.photons;
    }
    if (!preview_ || size != preview_size_) {
        preview_.reset(); // frees its memory before the new one takes its own
        preview_ = std::make_unique<Session>(*world_, *scene_, settings, methods_);
        preview_size_ = size;
    }
    device_.wait();
    device_.reset_stage_times();
    const Clock::time_point start = Clock::now();
    preview_->begin_frame(settings.seed);
    finish(*preview_, [](double) { return !interrupted(); });
    const Image small = std::move(preview_->layers().front().image);
    picture_ = upsampled(small, settings_.still.width, settings_.still.height);
    frame_time_->add(time_of(device_, seconds_since(start), size.photons > 0));
    frame.width = settings.width;
    frame.height = settings.height;
    frame.photons = size.photons;
}

void View::refine(ViewFrame& frame, const std::function<bool()>& keep_going) {
    RenderSettings settings = repeated(settings_.passes);
    if (!has_photons()) {
        settings.samples_per_pass = settings_.still.samples;
    }
    if (!still_) {
        still_ = std::make_unique<Session>(*world_, *scene_, settings, methods_);
    }
    if (!std::exchange(still_begun_, true)) {
        still_->begin_frame(settings.seed);
    }
    std::optional<PassPlan> plan = still_->next_pass();
    if (!plan && !still_->is_current(settings.seed)) { // it keeps photons, and has not enough yet
        still_->begin_frame(settings.seed);
        plan = still_->next_pass();
    }
    if (plan) {
        // Photons and samples that are too many for one pass of the session are spread over some.
        const bool repeats = is_progressive_method() || !has_photons();
        const std::uint64_t passes = repeats ? settings_.passes : 1;
        const auto parts = static_cast<std::uint64_t>(plan->expected) / passes;
        bool whole = true;
        do {
            whole = still_->step(*plan, [&](double) { return !interrupted() && keep_going(); });
            plan = still_->next_pass();
        } while (whole && plan && still_->passes() % parts != 0);
        if (whole) {
            picture_ = std::move(still_->layers().front().image);
            still_passes_ = still_->passes() / parts;
        } else { // a part of a pass would count as a whole one
            still_begun_ = false;
            still_passes_ = 0;
        }
    }
    frame.width = settings.width;
    frame.height = settings.height;
    frame.photons = has_photons() ? settings.photons : 0;
}

ViewFrame View::frame(const std::function<bool()>& keep_going) {
    const Clock::time_point start = Clock::now();
    ViewFrame frame{.number = frames_++, .moving = changed_};
    if (changed_) {
        follow_scene();
        still_begun_ = false;
        still_passes_ = 0;
        preview(frame);
        changed_ = false;
    } else {
        refine(frame, keep_going);
        frame.passes = still_passes_;
    }
    shows_still_ = !frame.moving && still_passes_ > 0;
    frame.seconds = seconds_since(start);
    return frame;
}

std::vector<Layer> View::layers() {
    return shows_still_ ? still_->layers() : std::vector<Layer>{{"", picture_}};
}

} // namespace argand
