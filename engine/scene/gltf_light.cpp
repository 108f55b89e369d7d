#include "scene/gltf_light.hpp"

#include "scene/gltf_value.hpp"
#include "scene/placement.hpp"
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

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

void read_cone(const GltfSource& source, const json* spot, Light& light, const std::string& what,
               Scene& scene) {
    constexpr double right_angle = std::numbers::pi / 2;
    const double outer = number_of(source, spot, "outerConeAngle", std::numbers::pi / 4, what);
    const double inner = number_of(source, spot, "innerConeAngle", 0, what);
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
    light.outer_cone_angle = static_cast<float>(outer_used);
    light.inner_cone_angle = std::min(static_cast<float>(inner_used), light.outer_cone_angle);
}

Light read_light(const GltfSource& source, const json* object, const std::string& what,
                 Scene& scene) {
    Light light;
    light.kind = kind_of(source, object, what);
    const glm::dvec3 color = vector_of(source, object, "color", glm::dvec3(1), what);
    const glm::dvec3 intensity = color * number_of(source, object, "intensity", 1, what);
    for (int channel = 0; channel < 3; ++channel) {
        if (!(intensity[channel] >= 0) ||
            !(intensity[channel] <= std::numeric_limits<float>::max())) {
            source.fail("{} has an intensity times colour of {}; it must be at least 0 and finite",
                        what, intensity[channel]);
        }
    }
    light.intensity = glm::vec3(intensity);
    if (light.kind == LightKind::spot) {
        read_cone(source, find_member(object, "spot"), light, what, scene);
    }
    if (find_member(object, "range")) {
        add_note(scene, "the range of lights is ignored: intensity falls off with the square of "
                        "the distance");
    }
    return light;
}

} // namespace

void add_lights(const GltfSource& source, const std::vector<GltfNode>& nodes, Scene& scene) {
    const json* lights = find_member(find_extension(&source.root, extension_name), "lights");
    for (std::size_t i = 0; i < nodes.size(); ++i) {
        const GltfNode& node = nodes[i];
        const json* reference =
            find_extension(find_element(source, "nodes", std::size_t(node.index)), extension_name);
        if (!reference) {
            continue;
        }
        const tinygltf::Node& carrier = source.model.nodes[std::size_t(node.index)];
        const json* number = find_member(reference, "light");
        const bool exists = number && number->is_number_unsigned() && lights &&
                            lights->is_array() && number->get<std::size_t>() < lights->size();
        if (!exists) {
            source.fail("{} refers to a light that does not exist",
                        label("node", node.index, carrier.name));
        }
        const std::size_t index = number->get<std::size_t>();
        const json* object = &(*lights)[index];
        const json* name = find_member(object, "name");
        const std::string own_name = name && name->is_string() ? name->get<std::string>() : "";
        const std::string what = label("light", static_cast<int>(index), own_name);
        Light light = read_light(source, object, what, scene);
        light.name = one_line(own_name.empty() ? carrier.name : own_name);
        const Light in_object_space = light;
        const bool has_direction = place(node.to_world, light);
        if (!has_direction) {
            light.intensity = glm::vec3(0); // until it moves
        }
        check_position(source, light.position, what);
        if (node.moves) {
            scene.motion.lights.push_back(
                {static_cast<std::uint32_t>(i), scene.lights.size(), in_object_space});
        }
        if (has_direction || node.moves) {
            scene.lights.push_back(light);
        } else {
            add_note(
                scene,
                fmt::format("{} is left out: its node's transform leaves it no direction", what));
        }
    }
}

} // namespace argand
