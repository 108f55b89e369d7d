#pragma once

#include "scene/scene.hpp"
#include "shared/light_record.h"
#include "shared/scene_records.h"
#include "world/texel_trees.hpp"

#include <cstdint>
#include <vector>

namespace argand {

/// The lights of a scene that have any power, grouped into emitters. An emitter is a punctual
/// light, the sky, or emissive triangles that are connected by common vertices.
///
/// A row is a light. Where the device makes the lights of emissive triangles (emissive_parts.hpp),
/// it is one that stands for a part of them, and triangles without power are lights, too.
struct LightTable {
    std::vector<LightRecord> lights;        ///< rows: punctual lights, emissive triangles, sky
    std::vector<double> weights;            ///< of each row: its power, as the mean of the channels
    std::vector<std::uint32_t> emitter;     ///< of each row
    std::vector<std::uint32_t> first_light; ///< of each row; empty: each row is one light
    std::vector<double> emitter_weights;
    glm::dvec3 power{0}; ///< of all lights, per channel
    double weight = 0;   ///< of all lights
    std::uint32_t light_count = 0;
    std::uint32_t first_triangle = 0, triangle_count = 0; ///< emissive triangles among the lights
};

/// Whether this is a sky or a directional light.
inline bool is_from_outside(const LightRecord& light) {
    return ((1u << light.kind) & light_kinds_from_outside) != 0;
}

/// The row to which a light belongs.
std::size_t row_of(const LightTable& table, std::uint32_t light);

/// For each material whether it emits light.
std::vector<bool> which_emit(const Scene& scene);

/// shining: the triangles that emit light; texels: of those that do by a texture. scene_radius: of
/// the bounding sphere, which determines the power of light from outside.
LightTable make_light_table(const Scene& scene, const std::vector<std::uint32_t>& shining,
                            const TexelTrees& texels, float scene_radius);

/// Adds a row of this power.
void add_row(LightTable& table, const LightRecord& light, const glm::dvec3& power);

/// Adds the rows of punctual lights, and of the sky, if they have any power.
void add_punctual_lights(const Scene& scene, float scene_radius, LightTable& table);
void add_sky(const Scene& scene, float scene_radius, LightTable& table);

/// The weights of emitters, from those of their rows.
std::vector<double> weights_of_emitters(const LightTable& table);

/// Probabilities with which each emitter is chosen if nothing is known about where its light
/// arrives: half of them in proportion to power, and half the same for all emitters.
/// So a lamp in a room is found even if a sun outside is a million times as powerful.
std::vector<double> plain_shares(const LightTable& table);

/// Light of each emitter that was found where it is needed.
struct FoundShares {
    std::vector<double> light;
    std::uint64_t samples = 0; ///< by which it was found
};

/// Shares in proportion to the light that was found, mixed with the plain shares. The more samples
/// there are for each emitter that was found, the less do the plain shares count. Equals the plain
/// shares if no light was found.
std::vector<double> learnt_shares(const LightTable& table, const FoundShares& found);

/// Table for choosing a row of an emitter that is chosen with a probability of its share. Within
/// an emitter, rows are chosen in proportion to power.
std::vector<LightChoice> light_choices(const LightTable& table, const std::vector<double>& shares);

} // namespace argand
