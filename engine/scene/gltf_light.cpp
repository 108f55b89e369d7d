#include "scene/gltf_light.hpp"

#include "scene/gltf_shared_keys.hpp"
#include "scene/gltf_value.hpp"
#include "scene/placement.hpp"
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

namespace argand {
namespace {

using nlohmann::json;

constexpr const char* extension_name = "KHR_lights_punctual";

LightKind kind_of(const GltfSource& source, const json* object, const std::string& what) {
    const json* type = find_member(object, "type");
    if (type && *type == "point") {
        return LightKind::point;
    }
    if (type && *type == "spot") {
        return LightKind::spot;
    }
    if (type && *type == "directional") {
        return LightKind::directional;
    }
    source.fail("{} is neither a point, nor a spot, nor a directional light", what);
}

void read_cone(const GltfSource& source, const json* spot, LightFactors& factors,
               const std::string& what, Scene& scene) {
    constexpr double right_angle = std::numbers::pi / 2;
    const double outer = number_of(source, spot, "outerConeAngle", factors.outer_cone_angle, what);
    const double inner = number_of(source, spot, "innerConeAngle", factors.inner_cone_angle, what);
    if (!(outer > 0) || inner < 0) {
        source.fail(
            "{} has cone angles of {} and {}; the outer must be above 0, the inner not below", what,
            outer, inner);
    }
    const double outer_used = std::min(outer, right_angle);
    const double inner_used = std::min(inner, outer_used);
    if (outer_used < outer || inner_used < inner) {
        add_note(scene,
                 fmt::format("{} has cone angles out of range; {} (outer) and {} (inner) are used",
                             what, outer_used, inner_used));
    }
    factors.outer_cone_angle = outer;
    factors.inner_cone_angle = inner;
}

LightFactors read_factors(const GltfSource& source, const json* object, LightKind kind,
                          const std::string& what, Scene& scene) {
    LightFactors factors;
    factors.color = vector_of(source, object, "color", glm::dvec3(1), what);
    factors.intensity = number_of(source, object, "intensity", 1, what);
    const glm::dvec3 intensity = factors.color * factors.intensity;
    for (int channel = 0; channel < 3; ++channel) {
        if (!(intensity[channel] >= 0) ||
            !(intensity[channel] <= std::numeric_limits<float>::max())) {
            source.fail("{} has an intensity times colour of {}; it must be at least 0 and finite",
                        what, intensity[channel]);
        }
    }
    if (kind == LightKind::spot) {
        read_cone(source, find_member(object, "spot"), factors, what, scene);
    }
    if (find_member(object, "range")) {
        add_note(scene, "the range of lights is ignored: intensity falls off with the square of "
                        "the distance");
    }
    return factors;
}

/// The index of the light to which a node refers.
std::size_t light_of(const GltfSource& source, const json* reference, const std::string& node) {
    const json* number = find_member(reference, "light");
    const bool exists =
        number && number->is_number_unsigned() && find_light(source, number->get<std::size_t>());
    if (!exists) {
        source.fail("{} refers to a light that does not exist", node);
    }
    return number->get<std::size_t>();
}

} // namespace

std::size_t light_count(const GltfSource& source) {
    const json* lights = find_member(find_extension(&source.root, extension_name), "lights");
    return lights && lights->is_array() ? lights->size() : 0;
}

const json* find_light(const GltfSource& source, std::size_t index) {
    return index < light_count(source)
               ? &(*find_member(find_extension(&source.root, extension_name), "lights"))[index]
               : nullptr;
}

void add_lights(const GltfSource& source, const std::vector<GltfNode>& nodes,
                std::vector<LightKeys> keys, Scene& scene) {
    SharedKeys table(std::move(keys));
    for (std::size_t i = 0; i < nodes.size(); ++i) {
        const GltfNode& node = nodes[i];
        const json* reference =
            find_extension(find_element(source, "nodes", std::size_t(node.index)), extension_name);
        if (!reference || node.is_instance) {
            continue;
        }
        const std::string& carrier = source.model.nodes[std::size_t(node.index)].name;
        const std::size_t index = light_of(source, reference, label("node", node.index, carrier));
        const json* object = find_light(source, index);
        const std::string own_name = name_of(object);
        const std::string what = label("light", static_cast<int>(index), own_name);
        Light light;
        light.kind = kind_of(source, object, what);
        light.name = one_line(own_name.empty() ? carrier : own_name);
        const LightFactors factors = read_factors(source, object, light.kind, what, scene);
        set_factors(factors, light);
        const Light in_object_space = light;
        const bool has_direction = place(node.to_world, light);
        check_position(source, light.position, what);
        if (!has_direction && !node.moves) {
            add_note(
                scene,
                fmt::format("{} is left out: its node's transform leaves it no direction", what));
            continue;
        }
        if (!has_direction) {
            light.intensity = glm::vec3(0); // until it moves
        }
        const int key_index = table.add(index, scene.motion.light_keys);
        if (node.moves || key_index >= 0) {
            scene.motion.lights.push_back({.node = static_cast<std::uint32_t>(i),
                                           .index = scene.lights.size(),
                                           .light = in_object_space,
                                           .keys = key_index,
                                           .factors = factors});
        }
        scene.lights.push_back(light);
    }
}

} // namespace argand
