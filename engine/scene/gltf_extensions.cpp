#include "scene/gltf_extensions.hpp"

#include "scene/gltf_compression.hpp"

#include <algorithm>
#include <array>

namespace argand {

bool supports_extension(std::string_view name) {
    if (missing_package(name)) {
        return false;
    }
    constexpr std::array<std::string_view, 18> supported{meshopt_extension,
                                                         "EXT_mesh_gpu_instancing",
                                                         draco_extension,
                                                         "KHR_animation_pointer",
                                                         "KHR_lights_punctual",
                                                         "KHR_materials_emissive_strength",
                                                         "KHR_materials_anisotropy",
                                                         "KHR_materials_clearcoat",
                                                         "KHR_materials_dispersion",
                                                         "KHR_materials_iridescence",
                                                         "KHR_materials_ior",
                                                         "KHR_materials_sheen",
                                                         "KHR_materials_specular",
                                                         "KHR_materials_transmission",
                                                         "KHR_materials_unlit",
                                                         "KHR_materials_volume",
                                                         "KHR_mesh_quantization",
                                                         "KHR_texture_transform"};
    return std::find(supported.begin(), supported.end(), name) != supported.end();
}

void add_extensions(const GltfSource& source, Scene& scene) {
    for (const std::string& name : source.model.extensionsRequired) {
        if (const char* package = missing_package(name)) {
            source.fail("it requires the extension {}, which this build of Argand cannot read; "
                        "install {} and build Argand again",
                        one_line(name, 80), package);
        }
        if (!supports_extension(name)) {
            source.fail("it requires the extension {}, which is not supported yet",
                        one_line(name, 80));
        }
    }
    for (const std::string& name : source.model.extensionsUsed) {
        if (std::find(scene.extensions_used.begin(), scene.extensions_used.end(), name) !=
            scene.extensions_used.end()) {
            continue;
        }
        scene.extensions_used.push_back(one_line(name));
        if (!supports_extension(name)) {
            add_note(scene, fmt::format("the extension {} is not supported and is ignored",
                                        one_line(name, 80)));
        }
    }
}

} // namespace argand
