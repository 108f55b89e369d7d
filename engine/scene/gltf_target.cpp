#include "scene/gltf_target.hpp"

#include "scene/gltf_light.hpp"
#include "scene/gltf_morph.hpp"
#include "scene/gltf_value.hpp"
#include <algorithm>
#include <charconv>
#include <limits>

namespace argand {
namespace {

using nlohmann::json;

/// A property that pointers may move.
template <class Keys> struct Property {
    std::string_view path; ///< within the object
    std::optional<KeyFrames> Keys::*keys;
    int components;
    const char* name;
};

constexpr Property<LightKeys> light_properties[] = {
    {"color", &LightKeys::color, 3, "colour"},
    {"intensity", &LightKeys::intensity, 1, "intensity"},
    {"spot/innerConeAngle", &LightKeys::inner_cone_angle, 1, "inner cone angle"},
    {"spot/outerConeAngle", &LightKeys::outer_cone_angle, 1, "outer cone angle"}};

constexpr Property<CameraKeys> camera_properties[] = {
    {"perspective/yfov", &CameraKeys::vertical_angle, 1, "angle of view"},
    {"orthographic/ymag", &CameraKeys::vertical_extent, 1, "height of view"}};

constexpr Property<MaterialKeys> material_properties[] = {
    {"pbrMetallicRoughness/baseColorFactor", &MaterialKeys::base_color, 4, "base colour"},
    {"pbrMetallicRoughness/metallicFactor", &MaterialKeys::metallic, 1, "metallic factor"},
    {"pbrMetallicRoughness/roughnessFactor", &MaterialKeys::roughness, 1, "roughness"},
    {"alphaCutoff", &MaterialKeys::alpha_cutoff, 1, "alpha cutoff"},
    {"emissiveFactor", &MaterialKeys::emissive, 3, "emission"},
    {"extensions/KHR_materials_emissive_strength/emissiveStrength",
     &MaterialKeys::emissive_strength, 1, "emissive strength"},
    {"extensions/KHR_materials_specular/specularFactor", &MaterialKeys::specular, 1,
     "specular factor"},
    {"extensions/KHR_materials_specular/specularColorFactor", &MaterialKeys::specular_color, 3,
     "specular colour"},
    {"extensions/KHR_materials_transmission/transmissionFactor", &MaterialKeys::transmission, 1,
     "transmission"},
    {"extensions/KHR_materials_ior/ior", &MaterialKeys::ior, 1, "index of refraction"},
    {"extensions/KHR_materials_volume/thicknessFactor", &MaterialKeys::thickness, 1, "thickness"},
    {"extensions/KHR_materials_volume/attenuationColor", &MaterialKeys::attenuation_color, 3,
     "attenuation colour"},
    {"extensions/KHR_materials_volume/attenuationDistance", &MaterialKeys::attenuation_distance, 1,
     "attenuation distance"},
    {"extensions/KHR_materials_clearcoat/clearcoatFactor", &MaterialKeys::coat, 1, "coat"},
    {"extensions/KHR_materials_clearcoat/clearcoatRoughnessFactor", &MaterialKeys::coat_roughness,
     1, "coat's roughness"},
    {"extensions/KHR_materials_dispersion/dispersion", &MaterialKeys::dispersion, 1, "dispersion"},
    {"extensions/KHR_materials_sheen/sheenColorFactor", &MaterialKeys::sheen_color, 3,
     "sheen's colour"},
    {"extensions/KHR_materials_sheen/sheenRoughnessFactor", &MaterialKeys::sheen_roughness, 1,
     "sheen's roughness"},
    {"extensions/KHR_materials_anisotropy/anisotropyStrength", &MaterialKeys::anisotropy, 1,
     "anisotropy"},
    {"extensions/KHR_materials_anisotropy/anisotropyRotation", &MaterialKeys::anisotropy_rotation,
     1, "anisotropy's rotation"},
    {"extensions/KHR_materials_iridescence/iridescenceFactor", &MaterialKeys::iridescence, 1,
     "iridescence"},
    {"extensions/KHR_materials_iridescence/iridescenceIor", &MaterialKeys::iridescence_ior, 1,
     "film's index of refraction"},
    {"extensions/KHR_materials_iridescence/iridescenceThicknessMaximum",
     &MaterialKeys::iridescence_thickness, 1, "film's thickness"}};

/// A pointer "LIST/INDEX/PROPERTY".
struct Pointed {
    std::size_t index;
    std::string_view property;
};

/// Splits a pointer into the list, which ends with a slash; none if it points elsewhere.
std::optional<Pointed> pointed(std::string_view pointer, std::string_view list) {
    if (!pointer.starts_with(list)) {
        return {};
    }
    pointer.remove_prefix(list.size());
    const std::size_t length = pointer.find('/');
    const std::string_view digits = pointer.substr(0, length);
    const bool is_index = !digits.empty() && length != std::string_view::npos &&
                          digits.find_first_not_of("0123456789") == std::string_view::npos &&
                          (digits.size() == 1 || digits[0] != '0'); // RFC 6901, section 4
    if (!is_index) {
        return {};
    }
    std::size_t index = 0;
    const auto read = std::from_chars(digits.data(), digits.data() + digits.size(), index);
    return Pointed{read.ec == std::errc() ? index : std::numeric_limits<std::size_t>::max(),
                   pointer.substr(length + 1)};
}

std::string label_of(const char* kind, std::size_t index, const json* object) {
    return label(kind, static_cast<int>(index), name_of(object));
}

/// The property of an object to which a pointer points. `objects`: the keys of all of its kind.
template <class Keys, std::size_t count>
KeyTarget property_target(const GltfSource& source, const Property<Keys> (&properties)[count],
                          const Pointed& at, std::vector<Keys>& objects, const char* kind,
                          const json* object, const std::string& what) {
    const auto* property =
        std::find_if(std::begin(properties), std::end(properties),
                     [&](const Property<Keys>& p) { return p.path == at.property; });
    if (property == std::end(properties)) {
        return {};
    }
    if (at.index >= objects.size()) {
        source.fail("{} moves {} {}, which does not exist", what, kind, at.index);
    }
    return {.keys = &(objects[at.index].*property->keys),
            .components = property->components,
            .moves = fmt::format("{} of {}", property->name, label_of(kind, at.index, object))};
}

/// Throws Error if a light or camera of another kind than the one that has the property is moved.
void check_kind(const GltfSource& source, const KeyTarget& target, const json* object,
                const Pointed& at, const std::string& what) {
    const std::string_view kind = at.property.substr(0, at.property.find('/'));
    const json* type = find_member(object, "type");
    const bool has_kind = kind != at.property;
    if (target.keys && has_kind && (!type || *type != kind)) {
        source.fail("{} moves the {}, whose type is not \"{}\"", what, target.moves, kind);
    }
}

} // namespace

FileKeys no_keys(const GltfSource& source) {
    FileKeys keys;
    keys.nodes.resize(source.model.nodes.size());
    keys.lights.resize(light_count(source));
    keys.materials.resize(source.model.materials.size());
    keys.cameras.resize(source.model.cameras.size());
    return keys;
}

KeyTarget node_target(const GltfSource& source, std::size_t index, std::string_view property,
                      FileKeys& keys, const std::string& what) {
    if (index >= keys.nodes.size()) {
        source.fail("{} moves node {}, which does not exist", what, index);
    }
    NodeKeys& node = keys.nodes[index];
    KeyTarget target{.components = 3,
                     .moves = fmt::format(
                         "{} of {}", property,
                         label("node", static_cast<int>(index), source.model.nodes[index].name))};
    if (property == "weights") {
        target.keys = &node.weights;
        target.components = 1;
        target.elements = morph_target_count(source, static_cast<int>(index));
        if (target.elements == 0) {
            source.fail("{} moves the morph targets of node {}, which has none", what, index);
        }
        return target;
    }
    if (property == "translation") {
        target.keys = &node.translation;
    } else if (property == "rotation") {
        target.keys = &node.rotation;
        target.components = 4;
        target.rotation = true;
    } else if (property == "scale") {
        target.keys = &node.scale;
    } else {
        source.fail("{} moves \"{}\", which glTF does not know", what,
                    one_line(std::string(property), 40));
    }
    if (!source.model.nodes[index].matrix.empty()) {
        source.fail("{} moves node {}, whose transform is a matrix", what, index);
    }
    return target;
}

KeyTarget pointer_target(const GltfSource& source, std::string_view pointer, FileKeys& keys,
                         const std::string& what) {
    if (const auto at = pointed(pointer, "/nodes/")) {
        const bool is_known = at->property == "translation" || at->property == "rotation" ||
                              at->property == "scale" || at->property == "weights";
        return is_known ? node_target(source, at->index, at->property, keys, what) : KeyTarget{};
    }
    if (const auto at = pointed(pointer, "/materials/")) {
        return property_target(source, material_properties, *at, keys.materials, "material",
                               find_element(source, "materials", at->index), what);
    }
    if (const auto at = pointed(pointer, "/cameras/")) {
        const json* camera = find_element(source, "cameras", at->index);
        KeyTarget target =
            property_target(source, camera_properties, *at, keys.cameras, "camera", camera, what);
        check_kind(source, target, camera, *at, what);
        return target;
    }
    if (const auto at = pointed(pointer, "/extensions/KHR_lights_punctual/lights/")) {
        const json* light = find_light(source, at->index);
        KeyTarget target =
            property_target(source, light_properties, *at, keys.lights, "light", light, what);
        check_kind(source, target, light, *at, what);
        return target;
    }
    return {};
}

} // namespace argand
