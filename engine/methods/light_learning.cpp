#include "methods/light_learning.hpp"

#include "base/error.hpp"
#include "methods/outside_aims.hpp"
#include "methods/photon_lights.hpp"
#include "methods/small_image.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <numeric>
#include <unordered_map>
#include <utility>

namespace argand {

namespace {

/// Copies what was learnt: where photons from inside the scene and eye paths are aimed, whether
/// near light is followed.
void copy_learnt(const SceneRecord& from, SceneRecord& to) {
    SceneRecord record = from;
    // Everything up to the targets belongs to the moment.
    std::memcpy(&record, &to, offsetof(SceneRecord, target_0));
    to = record;
}

/// Divides what was found in a pixel by the pixel's radiance, because errors count in relation to
/// it: light in the dark parts of an image is as important as in bright ones.
void make_relative(std::vector<FoundLight>& found) {
    constexpr double least_share = 0.01; // of the mean; a pixel with less counts less
    std::unordered_map<std::uint32_t, double> radiance; // of pixels
    double sum = 0;
    for (const FoundLight& f : found) {
        radiance[f.pixel] += f.radiance;
        sum += f.radiance;
    }
    const double least =
        least_share * sum / static_cast<double>(std::max<std::size_t>(radiance.size(), 1));
    for (FoundLight& f : found) {
        f.radiance /= radiance[f.pixel] + least;
    }
}

/// Saves or loads how photons from outside are aimed.
void persist_aims(Archive& archive, std::vector<LightAim>& aims) {
    auto count = static_cast<std::uint32_t>(aims.size());
    archive.value(count);
    for (std::uint32_t i = 0; i < count; ++i) {
        LightAim aim = archive.loads() ? LightAim() : aims[i];
        archive.value(aim.row);
        archive.value(aim.middle);
        archive.values(aim.tree);
        if (archive.loads()) {
            aims.push_back(std::move(aim));
        }
    }
}

bool are_aims(const std::vector<LightAim>& aims) {
    return std::all_of(aims.begin(), aims.end(), [](const LightAim& aim) {
        const glm::vec3& m = aim.middle;
        return std::isfinite(m.x + m.y + m.z) && is_aim_tree(aim.tree);
    });
}

/// Whether paths found light from outside which is reflected again, but too little of it to tell
/// where it comes from, as through the gaps of a blind.
bool is_rarely_found(const LightTable& table, std::span<const FoundLight> found) {
    constexpr std::uint32_t enough = 128;
    std::vector<std::uint32_t> times(table.lights.size(), 0);
    for (const FoundLight& f : found) {
        const std::uint32_t row = row_of(table, f.light);
        times[row] += f.indirect && is_from_outside(table.lights[row]) ? 1 : 0;
    }
    return std::any_of(times.begin(), times.end(),
                       [](std::uint32_t n) { return n > 0 && n < enough; });
}

/// The lights that eye paths find. If photons are aimed, further rounds of paths are traced as long
/// as light from outside is rarely found.
std::vector<FoundLight> find_lights(RenderContext& context, bool aims) {
    constexpr std::uint32_t most_rounds = 8;
    const DeviceScene& scene = context.on_device;
    std::vector<FoundLight> found;
    for (std::uint32_t round = 0; round < most_rounds; ++round) {
        const std::vector<FoundLight> of_round =
            sample_lights(context.device, scene, context.eye, context.settings,
                          context.scene.cameras[context.settings.camera], round);
        found.insert(found.end(), of_round.begin(), of_round.end());
        if (!aims || !is_rarely_found(scene.light_table, found)) {
            break;
        }
    }
    return found;
}

/// Adds what photons found to what eye paths found as indirect light. Of all lights together both
/// count one half; the one that has found nothing does not count.
void add_half(std::vector<FoundLight>& found, std::vector<FoundLight> of_photons) {
    constexpr std::size_t least = 16; // a few photons tell little
    if (of_photons.size() < least) {
        return;
    }
    const auto sum = [](std::span<const FoundLight> lights) {
        return std::accumulate(
            lights.begin(), lights.end(), 0.0,
            [](double s, const FoundLight& f) { return s + (f.indirect ? f.radiance : 0); });
    };
    const double of_paths = sum(found);
    if (of_paths > 0) {
        const double scale = of_paths / sum(of_photons);
        for (FoundLight& f : of_photons) {
            f.radiance *= scale;
        }
    }
    found.insert(found.end(), of_photons.begin(), of_photons.end());
}

void add(FoundShares& shares, std::uint32_t emitter, double light) {
    shares.light[emitter] += light;
    ++shares.samples;
}

} // namespace

void keep_learnt(RenderContext& context, const DeviceScene& before) {
    DeviceScene& scene = context.on_device;
    copy_learnt(before.record, scene.record);
    set_aims(context.device, scene, before.aims);
    const bool same_emitters = scene.light_table.emitter_weights.size() == before.ray_shares.size();
    const DeviceScene& choices = same_emitters ? before : scene;
    const std::vector<double> for_rays = choices.ray_shares, for_photons = choices.photon_shares;
    set_light_choices(context.device, scene, for_rays, for_photons);
    if (scene.plan.needs(Feature::photon_map) && std::isfinite(before.areas.part.reach)) {
        scene.areas = sample_areas(context.device, scene.photon_surfaces, before.areas.part);
    }
}

void persist_lights(Archive& archive, RenderContext& context) {
    DeviceScene learnt = context.on_device;
    archive.value(learnt.record);
    archive.values(learnt.ray_shares);
    archive.values(learnt.photon_shares);
    archive.value(learnt.areas.part);
    if (archive.loads()) {
        learnt.aims.clear();
    }
    persist_aims(archive, learnt.aims);
    if (!archive.loads()) {
        return;
    }
    const auto are_shares = [&](const std::vector<double>& shares) {
        return shares.size() == learnt.light_table.emitter_weights.size() &&
               std::all_of(shares.begin(), shares.end(),
                           [](double share) { return share >= 0 && share <= 1.001; });
    };
    if (!are_shares(learnt.ray_shares) || !are_shares(learnt.photon_shares) ||
        !are_aims(learnt.aims) || learnt.record.target_count > most_targets ||
        !(learnt.record.view_share >= 0 && learnt.record.view_share < 0.5f) ||
        !(learnt.record.near_distance >= 0) || learnt.record.follows_near > 1 ||
        learnt.record.close_light_count > most_close_lights || !(learnt.record.close_share >= 0) ||
        learnt.record.close_share * float(learnt.record.close_light_count) > 0.5f) {
        fail("loading a saved state: it has other lights than '{}'", context.scene.name);
    }
    keep_learnt(context, learnt);
}

void learn_lights(RenderContext& context) {
    DeviceScene& scene = context.on_device;
    const LightTable& table = scene.light_table;
    const bool photons = scene.plan.needs_photons() && context.settings.bounces > 0;
    const auto outside = std::count_if(table.lights.begin(), table.lights.end(), is_from_outside);
    const std::size_t emitters = table.emitter_weights.size();
    const bool aims = photons && outside > 0;
    if (emitters == 0 || (emitters == 1 && !aims)) {
        return;
    }
    const StageScope stage(context.device, "learn lights");
    std::vector<FoundLight> found = find_lights(context, aims);
    make_relative(found);
    // Where photons account for reflected light, shadow rays look for direct light only, but for
    // those of paths that go on where an estimate is not taken or surfaces are near.
    const bool direct_only =
        photons && scene.plan.needs(Feature::photon_map) && !context.settings.final_gather;
    FoundShares for_rays{.light = std::vector<double>(emitters, 0.0)};
    FoundShares for_photons = for_rays;
    for (const FoundLight& f : found) {
        const std::uint32_t emitter = table.emitter[row_of(table, f.light)];
        if (!f.indirect || !direct_only) {
            add(for_rays, emitter, f.radiance);
        }
    }
    if (aims) {
        set_aims(context.device, scene, learn_aims(scene, found));
    }
    // Behind mirrors and glass shadow rays find no lights, but photons come from there.
    if (photons && scene.plan.needs(Feature::photon_map) && may_hide_lights(scene)) {
        std::vector<FoundLight> of_photons = find_lights_of_photons(context);
        make_relative(of_photons);
        add_half(found, std::move(of_photons));
        if (aims) {
            set_aims(context.device, scene, learn_aims(scene, found));
        }
    }
    for (const FoundLight& f : found) {
        if (f.indirect) {
            add(for_photons, table.emitter[row_of(table, f.light)], f.radiance);
        }
    }
    set_light_choices(context.device, scene, learnt_shares(table, for_rays),
                      learnt_shares(table, for_photons));
}

} // namespace argand
