#include "sweep/sweep.hpp"

#include "plan/plan.hpp"
#include "scene/material_record.hpp"
#include "shared/follow.h"
#include "sweep/parameters.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <functional>
#include <set>

namespace argand {

namespace {

/// Turns a knob. The option's value is read from the settings' parameters, so that it is spelt as a
/// user would.
using Turn = std::function<void(RenderSettings&)>;

/// The settings of one method.
class MethodSweep {
public:
    explicit MethodSweep(RenderSettings base) : base_(std::move(base)) {
        seen_.insert(parameter_key(base_));
        settings_.push_back({"default", "", base_});
    }

    void turn(const std::string& knob, const Turn& change) {
        RenderSettings changed = base_;
        change(changed);
        if (seen_.insert(parameter_key(changed)).second) {
            settings_.push_back({knob, value_of(changed, knob), changed});
        }
    }

    template <class T>
    void turn(const std::string& knob, std::initializer_list<T> values,
              void (*set)(RenderSettings&, T)) {
        for (const T value : values) {
            turn(knob, [&](RenderSettings& settings) { set(settings, value); });
        }
    }

    const RenderSettings& base() const { return base_; }
    std::vector<Setting> take() { return std::move(settings_); }

private:
    static std::string value_of(const RenderSettings& settings, const std::string& knob) {
        for (const auto& [name, value] : parameters(settings)) {
            if (name == knob) {
                return value;
            }
        }
        return "";
    }

    RenderSettings base_;
    std::set<std::string> seen_;
    std::vector<Setting> settings_;
};

/// Short enough to be typed.
double rounded(double value) { return std::stod(fmt::format("{:.3g}", value)); }

constexpr double widths[] = {0.5, 2};

/// Radius, k or smoothing around what the method chose.
void turn_widths(MethodSweep& sweep, const RenderStatistics& learnt) {
    const std::string& method = sweep.base().method;
    for (const double factor : widths) {
        if (learnt.radius > 0) {
            sweep.turn("radius",
                       [&](RenderSettings& s) { s.radius = rounded(factor * learnt.radius); });
        }
        if (method == "knn" && learnt.neighbours > 0) {
            const auto k = static_cast<std::uint32_t>(std::max(factor * learnt.neighbours, 2.0));
            sweep.turn("k", [&](RenderSettings& s) { s.neighbours = k; });
        }
        if (method == "footprints" && learnt.smoothing > 0) {
            sweep.turn("smoothing", [&](RenderSettings& s) {
                s.footprints.smoothing = rounded(factor * learnt.smoothing);
            });
        }
    }
}

void turn_footprints(MethodSweep& sweep, const SceneUse& use) {
    if (use.followed) {
        for (const double factor : widths) {
            sweep.turn("caustic-smoothing",
                       [&](RenderSettings& s) { s.footprints.caustic_smoothing *= factor; });
        }
    }
    sweep.turn(
        "flatness", {0.1, 1.0},
        +[](RenderSettings& s, double value) { s.footprints.flatness = value; });
    sweep.turn("uniform-kernel", [](RenderSettings& s) { s.footprints.uniform_kernel = true; });
    sweep.turn("paper-axes", [](RenderSettings& s) { s.footprints.paper_axes = true; });
    sweep.turn("paper-reemission", [](RenderSettings& s) { s.footprints.paper_reemission = true; });
}

/// What all photon maps have.
void turn_map(MethodSweep& sweep) {
    sweep.turn(
        "query-cell", {0.0, 0.5}, +[](RenderSettings& s, double value) { s.query_cell = value; });
    sweep.turn(
        "leaf-size", {4u, 16u, 64u},
        +[](RenderSettings& s, unsigned value) { s.footprints.leaf_size = value; });
    sweep.turn("wide-codes", [](RenderSettings& s) { s.wide_codes = true; });
    sweep.turn("photon-sampling", [](RenderSettings& s) { s.photon_sampling = Sampling::random; });
    sweep.turn("final-gather", [](RenderSettings& s) { s.final_gather = true; });
}

void turn_samples(MethodSweep& sweep, Extent extent) {
    const auto set = +[](RenderSettings& s, unsigned value) { s.samples = value; };
    if (sweep.base().method == "path" && extent == Extent::full) {
        sweep.turn("spp", {1u, 4u, 16u, 64u, 256u}, set);
    } else if (sweep.base().method == "path") {
        sweep.turn("spp", {2u, 32u, 128u}, set);
    } else if (extent == Extent::full) {
        sweep.turn("spp", {2u, 4u, 16u, 32u}, set);
    } else {
        sweep.turn("spp", {32u}, set);
    }
}

void turn_photons(MethodSweep& sweep, Extent extent) {
    const auto set = +[](RenderSettings& s, std::uint64_t value) { s.photons = value; };
    if (extent == Extent::full) {
        sweep.turn<std::uint64_t>("photons", {10'000, 30'000, 100'000, 300'000, 1'000'000}, set);
    } else {
        sweep.turn<std::uint64_t>("photons", {10'000, 50'000, 1'000'000}, set);
    }
}

/// Roughnesses up to which lobes are followed that make another choice of lobes.
void turn_followed(MethodSweep& sweep, const Scene& scene) {
    const auto choice = [&](float roughness) {
        std::vector<std::uint32_t> lobes;
        for (const Material& material : scene.materials) {
            lobes.push_back(followed_lobes(material_record(material), roughness));
        }
        return lobes;
    };
    for (const float value : {0.0f, 0.5f}) {
        if (choice(value) != choice(sweep.base().follow_roughness)) {
            sweep.turn("follow-roughness", [&](RenderSettings& s) { s.follow_roughness = value; });
        }
    }
}

std::vector<Setting> sweep_method(const Scene& scene, const RenderSettings& base,
                                  const SceneUse& use, const RenderStatistics& learnt,
                                  Extent extent) {
    MethodSweep sweep(base);
    const bool full = extent == Extent::full;
    const bool asks = base.method != "path" && use.estimated && base.bounces > 0;
    if (!use.lit) {
        return sweep.take();
    }
    turn_samples(sweep, extent);
    if (asks) {
        turn_photons(sweep, extent);
    }
    // Without photons there is nothing whose treatment could matter.
    if (asks && base.photons > 0) {
        turn_widths(sweep, learnt);
        if (full) {
            turn_map(sweep);
        }
        if (full && base.method == "footprints") {
            turn_footprints(sweep, use);
        }
    }
    if (full && use.estimated) {
        sweep.turn(
            "bounces", {1u, 4u}, +[](RenderSettings& s, unsigned value) { s.bounces = value; });
    }
    if (full && asks && use.glossy) {
        turn_followed(sweep, scene);
    }
    return sweep.take();
}

} // namespace

SceneUse use_of(const Scene& scene, const RenderSettings& base) {
    const Plan plan = make_plan(scene, {.follow_roughness = base.follow_roughness});
    return {.lit = plan.light_kinds() != 0,
            .estimated = plan.needs(Feature::diffuse) || plan.needs(Feature::glossy_estimates),
            .followed = plan.needs(Feature::followed_paths),
            .glossy = plan.needs(Feature::ggx) || plan.needs(Feature::phong)};
}

std::vector<Setting> sweep(const Scene& scene, const RenderSettings& base,
                           const std::vector<std::string>& methods, const LearntWidths& learnt,
                           Extent extent) {
    const SceneUse use = use_of(scene, base);
    std::vector<Setting> all;
    std::set<std::string> seen;
    for (const std::string& method : methods) {
        if (!seen.insert(method).second) {
            continue;
        }
        RenderSettings of_method = base;
        of_method.method = method;
        const auto found = learnt.find(method);
        const std::vector<Setting> some =
            sweep_method(scene, of_method, use,
                         found == learnt.end() ? RenderStatistics() : found->second, extent);
        all.insert(all.end(), some.begin(), some.end());
    }
    return all;
}

} // namespace argand
