#include "scene/texture_mips.hpp"

namespace argand {

bool has_mips(const Scene& scene, const Material& material, const Texture& texture) {
    return texture.mips && texture.use == TextureUse::base_color && !material.alpha_varies &&
           scene.images[texture.image]->texels.size() > 1;
}

bool has_mips(const Scene& scene, const Material& material) {
    for (std::uint32_t i = 0; i < material.texture_count; ++i) {
        if (has_mips(scene, material, scene.textures[material.first_texture + i])) {
            return true;
        }
    }
    return false;
}

} // namespace argand
