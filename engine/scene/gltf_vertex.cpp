#include "scene/gltf_vertex.hpp"

#include <algorithm>
#include <cmath>

namespace argand {

namespace {

constexpr float one = 65535;

std::uint16_t in_unit(double value) {
    return static_cast<std::uint16_t>(std::lround(std::clamp(value, 0.0, 1.0) * one));
}

glm::u16vec4 color_of(const GltfAccessor& colors, std::size_t vertex) {
    glm::u16vec4 color(65535);
    for (int channel = 0; channel < colors.components; ++channel) {
        const double value = read_component(colors, vertex, channel);
        color[channel] = in_unit(std::isnan(value) ? 0 : value);
    }
    return color;
}

} // namespace

void add_texture_attributes(const GltfSource& source, const Surface& surface, std::size_t vertex,
                            std::uint32_t material, const std::string& name, Scene& scene) {
    const std::size_t first = scene.uvs.size();
    scene.uvs.resize(first + scene.uv_sets, glm::vec2(0));
    for (const auto& [set, accessor] : surface.uvs) {
        const glm::vec2 uv(read_component(accessor, vertex, 0),
                           read_component(accessor, vertex, 1));
        if (!std::isfinite(uv.x) || !std::isfinite(uv.y)) {
            source.fail("vertex {} of {} has texture coordinates that are not finite", vertex,
                        name);
        }
        scene.uvs[first + set] = uv;
    }
    if (surface.has_colors && scene.colors.empty()) {
        scene.colors.resize(scene.positions.size(), glm::u16vec4(65535));
    }
    if (surface.has_colors || !scene.colors.empty()) {
        scene.colors.push_back(surface.has_colors ? color_of(surface.colors, vertex)
                                                  : glm::u16vec4(65535));
        Material& of = scene.materials[material];
        if (scene.colors.back().a < 65535 && of.alpha_mode != AlphaMode::opaque) {
            of.alpha_varies = true;
        }
    }
}

} // namespace argand
