#pragma once

#include "animated.hpp"

#include <string>
#include <vector>

namespace argand::testing_gltf {

inline const std::string to_lamp = "/extensions/KHR_lights_punctual/lights/0/";
inline const std::string to_sun = "/extensions/KHR_lights_punctual/lights/1/";
inline const std::string to_material = "/materials/0/";
inline const std::string to_base_color = to_material + "pbrMetallicRoughness/baseColorFactor";
inline const std::string to_strength =
    to_material + "extensions/KHR_materials_emissive_strength/emissiveStrength";
inline const std::string to_transmission =
    to_material + "extensions/KHR_materials_transmission/transmissionFactor";
inline const std::string to_ior = to_material + "extensions/KHR_materials_ior/ior";

/// A triangle, a material, a spot light on two nodes, a sun, and two cameras.
inline Animated stage() {
    Animated file;
    json& root = file.builder.root;
    file.builder.add_triangles(right_triangle());
    root["meshes"][0]["primitives"][0]["material"] = 0;
    root["materials"] = {
        {{"name", "screen"},
         {"alphaMode", "BLEND"},
         {"emissiveFactor", {1, 0.5, 0.25}},
         {"pbrMetallicRoughness", {{"metallicFactor", 0.5}}},
         {"extensions",
          {{"KHR_materials_emissive_strength", {{"emissiveStrength", 2}}},
           {"KHR_materials_volume",
            {{"attenuationColor", {0.5, 0.25, 0.75}}, {"attenuationDistance", 2}}}}}}};
    root["extensions"]["KHR_lights_punctual"]["lights"] = {{{"type", "spot"},
                                                            {"name", "lamp"},
                                                            {"color", {1, 0.5, 0.25}},
                                                            {"intensity", 10},
                                                            {"spot", {{"outerConeAngle", 1}}}},
                                                           {{"type", "directional"}}};
    root["cameras"] = {{{"type", "perspective"}, {"perspective", {{"yfov", 1}, {"znear", 1}}}},
                       {{"type", "orthographic"},
                        {"orthographic", {{"xmag", 2}, {"ymag", 1}, {"znear", 1}, {"zfar", 9}}}}};
    for (const int light : {0, 0, 1}) {
        file.builder.add_node({{"translation", {0, light, 3}},
                               {"extensions", {{"KHR_lights_punctual", {{"light", light}}}}}});
    }
    file.builder.add_node({{"camera", 0}});
    file.builder.add_node({{"camera", 1}});
    return file;
}

/// The scene after its only key.
inline Scene with_value(Animated file, const std::string& pointer, const char* type,
                        const std::vector<float>& value) {
    file.animate_pointer(pointer, {0}, type, value);
    return file.load(1.0);
}

} // namespace argand::testing_gltf
