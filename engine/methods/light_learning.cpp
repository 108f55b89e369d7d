#include "methods/light_learning.hpp"

#include "base/error.hpp"
#include "shared/lights.h"

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

/// A number and how much it counts.
struct Weighted {
    double value = 0, weight = 0;
};

/// The least value such that this share of all weight lies at or below it. Requires some values.
double quantile(std::vector<Weighted> values, double share) {
    std::sort(values.begin(), values.end(),
              [](const Weighted& a, const Weighted& b) { return a.value < b.value; });
    double left =
        share * std::accumulate(values.begin(), values.end(), 0.0,
                                [](double sum, const Weighted& v) { return sum + v.weight; });
    for (const Weighted& v : values) {
        left -= v.weight;
        if (!(left > 0)) {
            return v.value;
        }
    }
    return values.back().value;
}

bool is_from_outside(const LightRecord& light) {
    return ((1u << light.kind) & light_kinds_from_outside) != 0;
}

/// The middle of where light arrives: the weighted median along each axis.
glm::vec3 middle_of(const std::vector<FoundLight>& found) {
    glm::vec3 center(0);
    for (int axis = 0; axis < 3; ++axis) {
        std::vector<Weighted> places;
        places.reserve(found.size());
        for (const FoundLight& f : found) {
            places.push_back({f.point[axis], f.radiance});
        }
        center[axis] = static_cast<float>(quantile(std::move(places), 0.5));
    }
    return center;
}

/// Aims photons at the places where light from outside arrives that is reflected into view. Of a
/// room whose window lets in the sun, the smallest sphere contains the patch of sun, and the
/// largest the ground before the window.
void set_focus(SceneRecord& record, const LightTable& table, const std::vector<FoundLight>& found) {
    constexpr std::size_t least_points = 16;
    constexpr std::array<double, 3> light_within = {0.6, 0.8, 0.95};
    constexpr std::array<float, 3> shares = {0.4f, 0.15f, 0.1f};
    constexpr double margin = 1.2;
    constexpr double largest = 0.5; // over the scene's sphere; larger ones gain too little
    std::vector<FoundLight> outside;
    std::copy_if(found.begin(), found.end(), std::back_inserter(outside), [&](const FoundLight& f) {
        return f.indirect && f.radiance > 0 &&
               is_from_outside(table.lights[row_of(table, f.light)]);
    });
    if (outside.size() < least_points) {
        return;
    }
    const glm::vec3 center = middle_of(outside);
    std::vector<Weighted> distances;
    distances.reserve(outside.size());
    for (const FoundLight& f : outside) {
        distances.push_back({glm::length(glm::dvec3(f.point) - glm::dvec3(center)), f.radiance});
    }
    record.focus_x = center.x;
    record.focus_y = center.y;
    record.focus_z = center.z;
    const std::array<std::pair<float*, float*>, 3> spheres = {
        {{&record.focus_radius_0, &record.focus_share_0},
         {&record.focus_radius_1, &record.focus_share_1},
         {&record.focus_radius_2, &record.focus_share_2}}};
    for (std::size_t i = 0; i < spheres.size(); ++i) {
        const double radius = margin * quantile(distances, light_within[i]);
        const bool gains = radius > 0 && radius < largest * record.radius;
        *spheres[i].first = gains ? static_cast<float>(radius) : record.radius;
        *spheres[i].second = gains ? shares[i] : 0.0f;
    }
}

/// Copies where photons are aimed.
void copy_aims(const SceneRecord& from, SceneRecord& to) {
    SceneRecord record = from;
    // Everything up to the aims belongs to the moment.
    std::memcpy(&record, &to, offsetof(SceneRecord, focus_x));
    to = record;
}

/// Divides what was found in a pixel by the pixel's radiance, because errors count in relation to
/// it: light in the dark parts of an image is as important as in bright ones.
void make_relative(FoundLights& found) {
    constexpr double least_share = 0.01; // of the mean; a pixel with less counts less
    std::unordered_map<std::uint32_t, double> radiance; // of pixels
    double sum = 0;
    for (const FoundLight& f : found.lights) {
        radiance[f.path / found.paths_per_pixel] += f.radiance;
        sum += f.radiance;
    }
    const double least =
        least_share * sum / static_cast<double>(std::max<std::size_t>(radiance.size(), 1));
    for (FoundLight& f : found.lights) {
        f.radiance /= radiance[f.path / found.paths_per_pixel] + least;
    }
}

void add(FoundShares& shares, std::uint32_t emitter, double light) {
    shares.light[emitter] += light;
    ++shares.samples;
}

} // namespace

void keep_learnt(RenderContext& context, const DeviceScene& before) {
    DeviceScene& scene = context.on_device;
    copy_aims(before.record, scene.record);
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
    if (!archive.loads()) {
        return;
    }
    const auto are_shares = [&](const std::vector<double>& shares) {
        return shares.size() == learnt.light_table.emitter_weights.size() &&
               std::all_of(shares.begin(), shares.end(),
                           [](double share) { return share >= 0 && share <= 1.001; });
    };
    if (!are_shares(learnt.ray_shares) || !are_shares(learnt.photon_shares) ||
        learnt.record.target_count > most_targets ||
        !(learnt.record.view_share >= 0 && learnt.record.view_share < 0.5f)) {
        fail("loading a saved state: it has other lights than '{}'", context.scene.name);
    }
    keep_learnt(context, learnt);
}

void learn_lights(RenderContext& context) {
    DeviceScene& scene = context.on_device;
    const LightTable& table = scene.light_table;
    const bool photons = scene.plan.needs(Feature::photon_map) && context.settings.bounces > 0;
    const auto outside = std::count_if(table.lights.begin(), table.lights.end(), is_from_outside);
    const std::size_t emitters = table.emitter_weights.size();
    if (emitters == 0 || (emitters == 1 && !(photons && outside > 0))) {
        return;
    }
    const StageScope stage(context.device, "learn lights");
    FoundLights found = sample_lights(context.device, scene, context.eye, context.settings,
                                      context.scene.cameras[context.settings.camera]);
    make_relative(found);
    // Where photons account for reflected light, shadow rays look for direct light only.
    const bool direct_only = photons && !context.settings.final_gather;
    FoundShares for_rays{.light = std::vector<double>(emitters, 0.0)};
    FoundShares for_photons = for_rays;
    for (const FoundLight& f : found.lights) {
        const std::uint32_t emitter = table.emitter[row_of(table, f.light)];
        if (!f.indirect || !direct_only) {
            add(for_rays, emitter, f.radiance);
        }
        if (f.indirect) {
            add(for_photons, emitter, f.radiance);
        }
    }
    if (photons && outside > 0) {
        set_focus(scene.record, table, found.lights);
    }
    set_light_choices(context.device, scene, learnt_shares(table, for_rays),
                      learnt_shares(table, for_photons));
}

} // namespace argand
