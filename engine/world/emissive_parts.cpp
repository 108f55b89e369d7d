#include "world/emissive_parts.hpp"

#include "kernels/emissive_choices.hpp"
#include "kernels/emissive_lights.hpp"
#include "world/connected_triangles.hpp"

#include <algorithm>
#include <iterator>
#include <limits>
#include <span>

namespace argand {

namespace {

/// Numbers the emitters of triangles in the order of their first triangles.
std::vector<std::uint32_t>
emitters_of(const Scene& scene, const std::vector<std::uint32_t>& shining, std::uint32_t& count) {
    DisjointSets sets = connected(scene, shining, movers(scene));
    std::vector<std::uint32_t> number(shining.size(), ~0u);
    std::vector<std::uint32_t> emitters;
    emitters.reserve(shining.size());
    for (std::uint32_t i = 0; i < shining.size(); ++i) {
        std::uint32_t& of_set = number[sets.root(i)];
        of_set = of_set == ~0u ? count++ : of_set;
        emitters.push_back(of_set);
    }
    return emitters;
}

/// The light that stands for the triangles of a part.
LightRecord light_of(const EmissiveSum& sum) {
    LightRecord light{};
    light.kind = light_triangle;
    light.x = light.dx = light.ex = sum.middle_x;
    light.y = light.dy = light.ey = sum.middle_y;
    light.z = light.dz = light.ez = sum.middle_z;
    return light;
}

/// Makes the lights of emissive triangles. Waits for the device.
std::vector<EmissiveSum> make_lights(Device& device, const EmissiveParts& emissive,
                                     const Buffer& positions, const Buffer& triangles,
                                     const Buffer& materials, std::uint32_t first_light,
                                     const Buffer& lights) {
    const std::size_t parts = emissive.ranges.size();
    const Buffer sums = device.allocate("sums of emissive parts", parts * sizeof(EmissiveSum));
    dispatch(device,
             kernels::emissive_lights{
                 .parts = emissive.parts,
                 .shining = emissive.triangles,
                 .positions = positions,
                 .triangles = triangles,
                 .materials = materials,
                 .lights = lights,
                 .sums = sums,
                 .means = emissive.texels ? emissive.texels
                                          : device.allocate("no texels", sizeof(TexelMean)),
                 .params = {static_cast<std::uint32_t>(parts), first_light},
                 .constants = {.by_texels = bool(emissive.texels)}},
             parts);
    return download<EmissiveSum>(device, sums, parts);
}

void upload_lights(Device& device, const std::vector<LightRecord>& lights, std::size_t to,
                   const Buffer& buffer) {
    if (!lights.empty()) {
        device.upload(buffer, to * sizeof(LightRecord), std::as_bytes(std::span(lights)));
    }
}

} // namespace

EmissiveParts find_emissive_parts(Device& device, const Scene& scene,
                                  const std::vector<std::uint32_t>& emitting,
                                  const TexelTrees& texels) {
    // Triangles of black texels are no lights, and join no others.
    std::vector<std::uint32_t> shining;
    shining.reserve(emitting.size());
    std::copy_if(emitting.begin(), emitting.end(), std::back_inserter(shining),
                 [&](std::uint32_t triangle) {
                     const TexelMean mean = mean_of(texels, triangle);
                     return mean.r > 0 || mean.g > 0 || mean.b > 0;
                 });
    EmissiveParts result;
    result.triangle_count = static_cast<std::uint32_t>(shining.size());
    const std::vector<std::uint32_t> emitters = emitters_of(scene, shining, result.emitter_count);
    for (std::uint32_t i = 0; i < shining.size(); ++i) {
        const bool continues = i > 0 && emitters[i] == emitters[i - 1] &&
                               result.ranges.back().count < most_triangles_of_emissive_part;
        if (!continues) {
            result.ranges.push_back({i, 0});
            result.emitter.push_back(emitters[i]);
        }
        ++result.ranges.back().count;
    }
    result.triangles = upload(device, "emissive triangles", shining);
    result.parts = upload(device, "parts of emissive triangles", result.ranges);
    if (!texels.triangles.empty()) {
        std::vector<TexelMean> means;
        means.reserve(shining.size());
        for (const std::uint32_t triangle : shining) {
            means.push_back(mean_of(texels, triangle));
        }
        result.texels = upload(device, "texels of emissive triangles", means);
    }
    return result;
}

LightTable make_light_table(Device& device, const Scene& scene, const EmissiveParts& emissive,
                            const Buffer& positions, const Buffer& triangles,
                            const Buffer& materials, float scene_radius, Buffer& lights) {
    LightTable table;
    add_punctual_lights(scene, scene_radius, table);
    LightTable sky;
    add_sky(scene, scene_radius, sky);
    table.first_triangle = static_cast<std::uint32_t>(table.lights.size());
    table.triangle_count = emissive.triangle_count;
    const std::uint32_t behind = table.first_triangle + table.triangle_count;
    table.light_count = behind + static_cast<std::uint32_t>(sky.lights.size());
    lights = device.allocate("lights", table.light_count * sizeof(LightRecord));
    upload_lights(device, table.lights, 0, lights);
    upload_lights(device, sky.lights, behind, lights);
    for (std::uint32_t i = 0; i < table.first_triangle; ++i) {
        table.first_light.push_back(i);
        table.emitter.push_back(i);
    }
    const std::vector<EmissiveSum> sums = make_lights(device, emissive, positions, triangles,
                                                      materials, table.first_triangle, lights);
    for (std::size_t i = 0; i < sums.size(); ++i) {
        add_row(table, light_of(sums[i]), {sums[i].power_r, sums[i].power_g, sums[i].power_b});
        table.first_light.push_back(table.first_triangle + emissive.ranges[i].first);
        table.emitter.push_back(table.first_triangle + emissive.emitter[i]);
    }
    if (!sky.lights.empty()) {
        add_row(table, sky.lights[0], sky.power);
        table.first_light.push_back(behind);
        table.emitter.push_back(table.first_triangle + emissive.emitter_count);
    }
    table.emitter_weights = weights_of_emitters(table);
    return table;
}

Buffer choices_of_lights(Device& device, const LightTable& table, const EmissiveParts& emissive,
                         const Buffer& lights, const std::vector<LightChoice>& rays,
                         const std::vector<LightChoice>& photons) {
    Buffer choices = device.allocate("light choices",
                                     std::uint64_t(2) * table.light_count * sizeof(LightChoice));
    std::uint32_t first = 0;
    for (std::vector<LightChoice> rows : {rays, photons}) {
        rows.push_back({.before = std::numeric_limits<std::uint32_t>::max()});
        const auto count = static_cast<std::uint32_t>(table.lights.size());
        dispatch(device,
                 kernels::emissive_choices{
                     .rows = upload(device, "rows of light choices", rows),
                     .parts = emissive.parts,
                     .lights = lights,
                     .light_choices = choices,
                     .params = {.rows = count,
                                .parts = static_cast<std::uint32_t>(emissive.ranges.size()),
                                .triangles = table.triangle_count,
                                .first_light = table.first_triangle,
                                .first_choice = first}},
                 count);
        first += table.light_count;
    }
    return choices;
}

} // namespace argand
