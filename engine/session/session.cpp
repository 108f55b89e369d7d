#include "session/session.hpp"

#include "base/error.hpp"
#include "methods/close_lights.hpp"
#include "methods/lens.hpp"
#include "methods/light_learning.hpp"
#include "methods/plan_render.hpp"
#include "world/world.hpp"

namespace argand {

Session::Session(World& world, const Scene& scene, const RenderSettings& settings,
                 MethodTable methods)
    : world_(world), scene_(scene), settings_(settings), methods_(methods),
      budget_(settings.budget), streams_(settings.seed) {
    methods.at(settings.method); // throws if there is none
}

/// Makes the memory of the first image, or readies it for another one.
void Session::prepare(std::uint32_t seed) {
    settings_.seed = seed;
    complete_.reset();
    followed_ = false;
    budget_ = Budget(settings_.budget);
    streams_ = Streams(seed);
    statistics_ = {};
    variance_ = {};
    DeviceScene on_device =
        world_.on_device(scene_, plan_render(scene_, world_.surfaces(), settings_, methods_));
    if (context_ && context_->on_device.plan.required == on_device.plan.required) {
        context_->on_device = std::move(on_device);
        set_camera(world_.device(), context_->eye, camera(context_->on_device));
        restart(world_.device(), context_->eye);
        return;
    }
    method_ = nullptr;
    context_.reset(); // frees its memory before the new one takes its own
    context_.emplace(RenderContext{.device = world_.device(),
                                   .scene = scene_,
                                   .settings = settings_,
                                   .on_device = std::move(on_device),
                                   .eye = {}});
    context_->eye = make_eye_workspace(world_.device(), context_->on_device.plan, settings_,
                                       camera(context_->on_device));
    method_ = methods_.at(settings_.method).make(*context_);
}

CameraRecord Session::camera(const DeviceScene& on_device) const {
    return camera_with_lens(world_.device(), on_device, scene_.cameras[settings_.camera],
                            settings_);
}

Session::Shown Session::now() const {
    return {world_.revision(), scene_.lights, scene_.sky, scene_.environment,
            scene_.cameras[settings_.camera]};
}

bool Session::is_current(std::uint32_t seed) const {
    return complete_ && seed == settings_.seed && *complete_ == now() && method_->is_settled();
}

void Session::follow() {
    followed_ = true;
    Device& device = world_.device();
    const DeviceScene before = context_->on_device;
    // What an earlier moment required, this one gets as well: the memory stays of one kind.
    Plan plan = plan_render(scene_, world_.surfaces(), settings_, methods_);
    plan.required.insert(before.plan.required.begin(), before.plan.required.end());
    const bool requires_more = plan.required.size() != before.plan.required.size();
    context_->on_device = world_.on_device(scene_, plan);
    CameraRecord view =
        camera_record(scene_.cameras[settings_.camera], settings_.width, settings_.height);
    // What crosses the middle of the picture does not take the focus while the shutter is open.
    copy_lens(context_->eye.queries.view, view);
    if (requires_more) {
        const Film film = context_->eye.film;
        context_->eye = {}; // frees its memory before the new one takes its own
        context_->eye = make_eye_workspace(device, plan, settings_, view);
        context_->eye.film = film;
    }
    set_camera(device, context_->eye, view);
    keep_learnt(*context_, before);
}

void Session::begin_frame(std::uint32_t seed) {
    prepare(seed);
    learn_lights(*context_);
    aim_at_close_lights(*context_);
    method_->begin_frame(budget_);
}

void Session::persist(Archive& archive) {
    archive.value(statistics_.passes);
    streams_.persist(archive);
    budget_.persist(archive);
    persist_lights(archive, *context_);
    method_->persist(archive);
    persist_film(archive, context_->device, context_->eye.film);
}

void Session::resume(std::span<const std::uint8_t> state, std::uint32_t seed) {
    prepare(seed);
    Archive archive(state);
    try {
        persist(archive);
        if (!archive.at_end()) {
            fail("loading a saved state: it is longer than that of '{}'", settings_.method);
        }
    } catch (...) {
        method_ = nullptr;
        context_.reset();
        throw;
    }
}

std::vector<std::uint8_t> Session::save() {
    Archive archive;
    persist(archive);
    return std::move(archive).take_bytes();
}

std::optional<PassPlan> Session::next_pass() {
    if (passes() > 0 && !budget_.another(passes(), method_->passes())) {
        if (!statistics_.interrupted && !followed_) {
            complete_ = now();
        }
        return std::nullopt;
    }
    return PassPlan{.expected = budget_.expected(passes(), method_->passes())};
}

bool Session::step(const PassPlan& plan, const OnProgress& on_part) {
    complete_.reset();
    if (passes() > 0) {
        budget_.start_pass(); // what the caller did since the last one is no part of it
    }
    const Pass pass{.expected = plan.expected,
                    .numbers = streams_.next(plan.stream, method_->passes_per_seed()),
                    .keeps_width = plan.keeps_width};
    const bool finished = method_->pass(pass, on_part);
    ++statistics_.passes;
    statistics_.interrupted = !finished;
    if (settings_.variance) {
        variance_.add_pass(context_->device, context_->eye.film);
    }
    return finished;
}

double Session::share(double part) const {
    return budget_.share(passes(), part, method_->passes());
}

std::string Session::describe() const {
    const std::string words = passes() > 0 ? method_->describe_pass() : "";
    return words.empty() ? words : fmt::format("pass {}, {}", passes(), words);
}

std::vector<Layer> Session::layers() {
    return resolve_film(context_->device, context_->eye.film, statistics_);
}

RenderResult Session::result() {
    method_->report(statistics_);
    statistics_.texture_halvings = context_->on_device.texture_halvings;
    if (const auto& sky = context_->on_device.sky_table; sky && sky->halvings > 0) {
        statistics_.reduced_sky = {sky->width, sky->height};
    }
    std::vector<Layer> image = layers();
    if (settings_.variance) {
        image.push_back({"variance", variance_.of_mean(context_->eye.film)});
    }
    return {.layers = std::move(image), .statistics = statistics_};
}

} // namespace argand
