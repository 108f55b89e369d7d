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
#include <new>
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

/// The scene as it was, once these edits were seen to apply to it. Throws Error if they do not.
Scene tried(Scene scene, const Edits& edits) {
    SceneEditor editor(scene);
    editor.apply(edits, scene);
    editor.apply({}, scene);
    return scene;
}

bool same(const SolidRanks& a, const SolidRanks& b) {
    return a.materials == b.materials && a.of_material == b.of_material &&
           a.overlapping == b.overlapping;
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
    if (settings_.still.camera >= scene_->cameras.size()) {
        settings_.still.camera = 0;
    }
    changed_ = true;
    is_warm_ = false;
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
    const Edits edits = again ? applied_ : Edits();
    const std::optional<double> seconds = again ? scene_->seconds : std::nullopt;
    show(tried(load_(file, seconds, again && movable_nodes_), edits));
    apply(edits);
    if (!again) {
        file_ = file;
        movable_nodes_ = false;
        edits_ = nlohmann::json::object();
    }
}

void View::edit(const nlohmann::json& patch) {
    nlohmann::json merged = edits_;
    merged.merge_patch(patch);
    set_edits(std::move(merged));
}

void View::set_edits(nlohmann::json all) {
    Edits edits = parse_edits(all, "edits");
    if (edits.has_nodes && !movable_nodes_) {
        show(tried(load_(file_, scene_->seconds, true), edits));
        movable_nodes_ = true;
    }
    if (movable_nodes_ && !edits.has_nodes) { // a render of these edits must load the same scene
        all["nodes"] = nlohmann::json::object();
        edits.has_nodes = true;
    }
    apply(edits);
    edits_ = std::move(all);
}

void View::set_time(std::optional<double> seconds) {
    const std::optional<double> before = std::exchange(scene_->seconds, seconds);
    try {
        editor_->apply(applied_, *scene_);
    } catch (const Error&) {
        scene_->seconds = before;
        editor_->apply(applied_, *scene_);
        throw;
    }
    changed_ = true;
}

void View::change_settings(RenderSettings settings) {
    settings_.still = std::move(settings);
    preview_.reset();
    still_.reset();
    changed_ = true;
    is_warm_ = false;
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
    if (option->ends_render) { // how many passes there are, which the view decides
        settings_.passes = std::max(settings.progressive.passes, 1u);
        settings.progressive.passes = 1;
    }
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
        constexpr std::uint64_t most = numbers_of_seed;
        settings.samples =
            static_cast<std::uint32_t>(std::min(std::uint64_t(settings.samples) * passes, most));
    }
    return settings;
}

RenderSettings View::equivalent() const {
    return repeated(static_cast<std::uint32_t>(std::max<std::uint64_t>(picture_passes_, 1)));
}

void View::follow_scene() {
    if (world_ && !same(known_solid_ranks(*scene_), world_->surfaces().solids)) {
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

void View::preview(ViewFrame& frame, Clock::time_point start) {
    const PreviewSize size = frame_time_->next();
    RenderSettings settings = settings_.still;
    const auto scaled = [&](int side) {
        return std::max(static_cast<int>(std::ceil(side * size.scale)), 1);
    };
    settings.width = scaled(settings.width);
    settings.height = scaled(settings.height);
    settings.samples = 1;
    // Paths that go on where estimates are poor take a third of so short a time, in many rounds of
    // few paths.
    settings.least_coverage = 0;
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
    preview_->begin_frame(settings.seed);
    finish(*preview_, [](double) { return !interrupted(); });
    const Image small = std::move(preview_->layers().front().image);
    set_picture(upsampled(small, settings_.still.width, settings_.still.height), 0);
    if (std::exchange(is_warm_, true)) {
        frame_time_->add(time_of(device_, seconds_since(start), size.photons > 0));
    }
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
    if (!still_begun_) {
        still_->begin_frame(settings.seed);
        still_begun_ = true;
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
        const auto parts =
            std::max<std::uint64_t>(static_cast<std::uint64_t>(plan->expected) / passes, 1);
        bool whole = true;
        do {
            whole = still_->step(*plan, [&](double) { return !interrupted() && keep_going(); });
            plan = still_->next_pass();
        } while (whole && plan && still_->passes() % parts != 0);
        if (whole) {
            still_passes_ = still_->passes() / parts;
            set_picture(std::move(still_->layers().front().image), still_passes_);
        } else { // a part of a pass would count as a whole one
            still_begun_ = false;
            still_passes_ = 0;
        }
    }
    frame.width = settings.width;
    frame.height = settings.height;
    frame.photons = has_photons() ? settings.photons : 0;
}

void View::set_picture(Image picture, std::uint64_t passes) {
    picture_ = std::move(picture);
    picture_passes_ = passes;
    ++pictures_;
}

/// Returns to what was last shown at rest.
void View::go_back() {
    preview_.reset();
    still_.reset();
    world_.reset();
    changed_ = true;
    is_warm_ = false;
    if (!shown_) {
        return;
    }
    const Shown before = *shown_;
    settings_ = before.settings;
    restart_frame_time();
    if (file_ != before.file || movable_nodes_ != before.movable_nodes) {
        show(load_(before.file, before.seconds, before.movable_nodes));
        file_ = before.file;
        movable_nodes_ = before.movable_nodes;
    }
    scene_->seconds = before.seconds;
    apply(parse_edits(before.edits, "edits"));
    edits_ = before.edits;
}

ViewFrame View::frame(const std::function<bool()>& keep_going) {
    try {
        return render(keep_going);
    } catch (const DeviceFault&) {
        throw;
    } catch (const Error&) {
        go_back();
        throw;
    } catch (const std::bad_alloc&) {
        go_back();
        fail("showing '{}': the machine is out of memory; ask for a smaller picture or fewer "
             "photons",
             scene_->name);
    }
}

ViewFrame View::render(const std::function<bool()>& keep_going) {
    const Clock::time_point start = Clock::now();
    ViewFrame frame{.number = frames_, .moving = changed_};
    if (changed_) {
        still_begun_ = false;
        still_passes_ = 0;
        if (methods_.at(settings_.still.method).abilities.keeps_photons) {
            still_.reset(); // a render of this moment has none from before
        }
        follow_scene();
        preview(frame, start);
        changed_ = false;
    } else {
        refine(frame, keep_going);
        frame.passes = still_passes_;
    }
    if (!frame.moving || !shown_) {
        shown_ = {file_, movable_nodes_, edits_, scene_->seconds, settings_};
    }
    ++frames_;
    frame.picture = pictures_;
    frame.seconds = seconds_since(start);
    return frame;
}

std::vector<Layer> View::layers() {
    return still_ && still_begun_ && still_passes_ > 0 ? still_->layers()
                                                       : std::vector<Layer>{{"", picture_}};
}

} // namespace argand
