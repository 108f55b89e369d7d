#include "world/light_table.hpp"

#include "base/disjoint_sets.hpp"
#include "base/hash_floats.hpp"
#include "scene/material_record.hpp"
#include "shared/emissive.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <unordered_map>

namespace argand {

namespace {

LightRecord record_of(const Light& light) {
    LightRecord record{};
    switch (light.kind) { // without a default, so that the compiler finds a kind that is missing
    case LightKind::point:
        record.kind = light_point;
        break;
    case LightKind::spot:
        record.kind = light_spot;
        break;
    case LightKind::directional:
        record.kind = light_directional;
        break;
    }
    record.x = light.position.x;
    record.y = light.position.y;
    record.z = light.position.z;
    record.dx = light.direction.x;
    record.dy = light.direction.y;
    record.dz = light.direction.z;
    record.r = light.intensity.r;
    record.g = light.intensity.g;
    record.b = light.intensity.b;
    record.cos_inner = std::cos(light.inner_cone_angle);
    record.cos_outer = std::cos(light.outer_cone_angle);
    return record;
}

using Position = std::array<float, 3>;

/// Numbers the emitters in the order of their first lights.
std::vector<std::uint32_t> find_emitters(const std::vector<LightRecord>& lights) {
    DisjointSets sets(lights.size());
    std::unordered_map<Position, std::uint32_t, HashFloats> light_at;
    for (std::uint32_t i = 0; i < lights.size(); ++i) {
        const LightRecord& l = lights[i];
        if (l.kind == light_triangle) {
            for (const Position& corner :
                 {Position{l.x, l.y, l.z}, {l.dx, l.dy, l.dz}, {l.ex, l.ey, l.ez}}) {
                const auto [there, is_new] = light_at.try_emplace(corner, i);
                if (!is_new) {
                    sets.join(there->second, i);
                }
            }
        }
    }
    std::vector<std::uint32_t> number(lights.size(), ~0u);
    std::vector<std::uint32_t> emitters;
    std::uint32_t count = 0;
    for (std::uint32_t i = 0; i < lights.size(); ++i) {
        std::uint32_t& of_set = number[sets.root(i)];
        of_set = of_set == ~0u ? count++ : of_set;
        emitters.push_back(of_set);
    }
    return emitters;
}

double weight_of(const glm::dvec3& power) { return (power.r + power.g + power.b) / 3; }

/// Adds a light, unless it has no power.
void add_light(LightTable& table, const LightRecord& light, float scene_radius) {
    const glm::dvec3 power(light_power(light, all_light_kinds, scene_radius));
    if (weight_of(power) > 0) {
        add_row(table, light, power);
    }
}

} // namespace

std::size_t row_of(const LightTable& table, std::uint32_t light) {
    if (table.first_light.empty()) {
        return light;
    }
    const auto after = std::upper_bound(table.first_light.begin(), table.first_light.end(), light);
    return static_cast<std::size_t>(after - table.first_light.begin()) - 1;
}

std::vector<bool> which_emit(const Scene& scene) {
    std::vector<bool> emitting;
    emitting.reserve(scene.materials.size());
    for (const Material& material : scene.materials) {
        emitting.push_back(emits(material));
    }
    return emitting;
}

void add_row(LightTable& table, const LightRecord& light, const glm::dvec3& power) {
    table.lights.push_back(light);
    table.power += power;
    table.weights.push_back(weight_of(power));
    table.weight += table.weights.back();
}

void add_punctual_lights(const Scene& scene, float scene_radius, LightTable& table) {
    for (const Light& light : scene.lights) {
        add_light(table, record_of(light), scene_radius);
    }
}

void add_sky(const Scene& scene, float scene_radius, LightTable& table) {
    if (scene.sky) {
        LightRecord sky{};
        sky.kind = light_sky;
        sky.r = scene.sky->r;
        sky.g = scene.sky->g;
        sky.b = scene.sky->b;
        add_light(table, sky, scene_radius);
    } else if (scene.environment) {
        const glm::vec3 mean(mean_radiance(*scene.environment));
        LightRecord picture{};
        picture.kind = light_picture;
        picture.r = mean.r;
        picture.g = mean.g;
        picture.b = mean.b;
        // Kernels set the direction. The host tells pictures apart by it (light_change.hpp).
        const std::uint64_t hash = fingerprint(*scene.environment);
        picture.dx = static_cast<float>(hash & 0xffffffu);
        picture.dy = static_cast<float>(hash >> 24u & 0xffffffu);
        add_light(table, picture, scene_radius);
    }
}

std::vector<double> weights_of_emitters(const LightTable& table) {
    std::vector<double> weights;
    for (std::size_t i = 0; i < table.lights.size(); ++i) {
        weights.resize(std::max<std::size_t>(weights.size(), table.emitter[i] + 1), 0.0);
        weights[table.emitter[i]] += table.weights[i];
    }
    return weights;
}

LightTable make_light_table(const Scene& scene, const std::vector<std::uint32_t>& shining,
                            const TexelTrees& texels, float scene_radius) {
    LightTable table;
    add_punctual_lights(scene, scene_radius, table);
    table.first_triangle = static_cast<std::uint32_t>(table.lights.size());
    for (const std::uint32_t i : shining) {
        const glm::uvec3& corners = scene.triangles[i];
        LightRecord light = emissive_light(
            i, scene.positions[corners.x], scene.positions[corners.y], scene.positions[corners.z],
            material_record(scene.materials[scene.triangle_material[i]]));
        shine_by_texels(light, mean_of(texels, i));
        add_light(table, light, scene_radius);
    }
    table.triangle_count = static_cast<std::uint32_t>(table.lights.size()) - table.first_triangle;
    add_sky(scene, scene_radius, table);
    table.light_count = static_cast<std::uint32_t>(table.lights.size());
    table.emitter = find_emitters(table.lights);
    table.emitter_weights = weights_of_emitters(table);
    return table;
}

std::vector<double> plain_shares(const LightTable& table) {
    std::vector<double> shares;
    shares.reserve(table.emitter_weights.size());
    const auto count = static_cast<double>(std::count_if(table.emitter_weights.begin(),
                                                         table.emitter_weights.end(),
                                                         [](double weight) { return weight > 0; }));
    for (const double weight : table.emitter_weights) {
        shares.push_back(weight > 0 ? 0.5 * weight / table.weight + 0.5 / count : 0);
    }
    return shares;
}

std::vector<double> learnt_shares(const LightTable& table, const FoundShares& found) {
    constexpr double most_trust = 0.95;
    constexpr double samples_per_emitter = 2; // for half of the trust
    std::vector<double> shares = plain_shares(table);
    const double sum = std::accumulate(found.light.begin(), found.light.end(), 0.0);
    if (!(sum > 0)) {
        return shares;
    }
    const auto emitters = static_cast<double>(std::count_if(
        found.light.begin(), found.light.end(), [](double light) { return light > 0; }));
    const auto samples = static_cast<double>(found.samples);
    const double trust = most_trust * samples / (samples + samples_per_emitter * emitters);
    for (std::size_t i = 0; i < shares.size(); ++i) {
        shares[i] = (1 - trust) * shares[i] + trust * found.light[i] / sum;
    }
    return shares;
}

std::vector<LightChoice> light_choices(const LightTable& table, const std::vector<double>& shares) {
    std::vector<LightChoice> choices;
    choices.reserve(table.lights.size());
    constexpr double digits = 4294967296.0;
    double before = 0;
    for (std::size_t i = 0; i < table.lights.size(); ++i) {
        const double share = shares[table.emitter[i]];
        const double probability =
            share > 0 ? share * table.weights[i] / table.emitter_weights[table.emitter[i]] : 0;
        choices.push_back(
            {.before = static_cast<std::uint32_t>(std::min(before * digits, digits - 1)),
             .probability = static_cast<float>(probability),
             .emitter_probability = static_cast<float>(share),
             .pad = 0});
        before += probability;
    }
    return choices;
}

} // namespace argand
