#include "world/texture_table.hpp"

#include "base/thread_each.hpp"
#include "image/srgb.hpp"
#include "scene/texture_mips.hpp"
#include "shared/texture_record.h"
#include "world/mip_maps.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <memory>
#include <span>
#include <vector>

namespace argand {

namespace {

std::uint8_t byte_of(double unit) {
    return static_cast<std::uint8_t>(std::lround(std::clamp(unit, 0.0, 1.0) * 255));
}

std::array<double, srgb_codes> linear_values() {
    std::array<double, srgb_codes> values{};
    for (std::size_t code = 0; code < values.size(); ++code) {
        values[code] = srgb_decode(static_cast<double>(code) / 255);
    }
    return values;
}

std::uint32_t wrap_flag(Wrap wrap) {
    switch (wrap) {
    case Wrap::repeat:
        return texture_repeat;
    case Wrap::mirrored_repeat:
        return texture_mirror;
    case Wrap::clamp_to_edge:
        break;
    }
    return texture_clamp;
}

std::uint32_t use_flag(TextureUse use) {
    switch (use) {
    case TextureUse::specular_color:
        return texture_of_specular_color << texture_use_shift;
    case TextureUse::transmission:
        return texture_of_transmission << texture_use_shift;
    case TextureUse::thickness:
        return texture_of_thickness << texture_use_shift;
    case TextureUse::coat:
        return texture_of_coat << texture_use_shift;
    case TextureUse::coat_roughness:
        return texture_of_coat_roughness << texture_use_shift;
    case TextureUse::coat_normal:
        return texture_of_coat_normal << texture_use_shift;
    case TextureUse::sheen_color:
        return texture_of_sheen_color << texture_use_shift;
    case TextureUse::sheen_roughness:
        return texture_of_sheen_roughness << texture_use_shift;
    case TextureUse::film:
        return texture_of_film << texture_use_shift;
    case TextureUse::film_thickness:
        return texture_of_film_thickness << texture_use_shift;
    case TextureUse::anisotropy:
        return texture_of_anisotropy << texture_use_shift;
    default:
        return 0;
    }
}

TextureRecord record_of(const Texture& texture, const TextureImage& image) {
    const glm::mat3x2& m = texture.transform;
    const std::uint32_t flags = wrap_flag(texture.wrap_u) |
                                wrap_flag(texture.wrap_v) << texture_wrap_v |
                                (texture.nearest ? texture_nearest : 0u) |
                                (texture.srgb ? texture_srgb : 0u) | use_flag(texture.use);
    return {.uu = m[0].x,
            .uv = m[1].x,
            .u0 = m[2].x,
            .vu = m[0].y,
            .vv = m[1].y,
            .v0 = m[2].y,
            .width = image.width,
            .height = image.height,
            .first = 0,
            .uv_set = texture.uv_set,
            .flags = flags,
            .scale = texture.scale};
}

std::vector<bool> have_mips(const Scene& scene) {
    std::vector<bool> mips(scene.images.size(), false);
    for (const Material& material : scene.materials) {
        for (std::uint32_t i = 0; i < material.texture_count; ++i) {
            const Texture& texture = scene.textures[material.first_texture + i];
            mips[texture.image] = mips[texture.image] || has_mips(scene, material, texture);
        }
    }
    return mips;
}

} // namespace

TextureImage halved(const TextureImage& image, bool srgb) {
    static const std::array<double, srgb_codes> linear_of = linear_values();
    TextureImage half{.name = image.name,
                      .width = std::max(image.width / 2, 1u),
                      .height = std::max(image.height / 2, 1u),
                      .low = image.low,
                      .high = image.high};
    half.texels.reserve(std::size_t{half.width} * half.height);
    for (std::uint32_t y = 0; y < half.height; ++y) {
        for (std::uint32_t x = 0; x < half.width; ++x) {
            // An odd column or row at the end is left out, as in mip maps.
            glm::dvec3 sum(0), weighted(0);
            double alpha = 0;
            for (std::uint32_t corner = 0; corner < 4; ++corner) {
                const std::uint32_t column = std::min(2 * x + corner % 2, image.width - 1);
                const std::uint32_t row = std::min(2 * y + corner / 2, image.height - 1);
                const auto texel = std::bit_cast<glm::u8vec4>(
                    image.texels[std::size_t{row} * image.width + column]);
                const glm::dvec3 color =
                    srgb ? glm::dvec3(linear_of[texel.r], linear_of[texel.g], linear_of[texel.b])
                         : glm::dvec3(texel) / 255.0;
                sum += color;
                weighted += color * double(texel.a);
                alpha += double(texel.a);
            }
            const glm::dvec3 mean = alpha > 0 ? weighted / alpha : sum / 4.0;
            glm::u8vec4 texel(0, 0, 0, byte_of(alpha / (4 * 255)));
            for (int channel = 0; channel < 3; ++channel) {
                texel[channel] = byte_of(srgb ? srgb_encode(mean[channel]) : mean[channel]);
            }
            half.texels.push_back(std::bit_cast<std::uint32_t>(texel));
        }
    }
    return half;
}

FittingImages fitting_images(const Scene& scene, std::uint64_t most) {
    FittingImages result{.images = scene.images, .halvings = 0};
    auto& images = result.images;
    std::vector<bool> srgb(images.size(), false);
    for (const Texture& texture : scene.textures) {
        srgb[texture.image] = srgb[texture.image] || texture.srgb;
    }
    const std::vector<bool> mips = have_mips(scene);
    const auto total = [&] {
        std::uint64_t sum = 0;
        for (std::size_t i = 0; i < images.size(); ++i) {
            sum += images[i]->texels.size() + (mips[i] ? mip_word_count(*images[i]) : 0);
        }
        return sum;
    };
    std::vector<std::uint32_t> times(images.size(), 0);
    while (total() > most) {
        const auto largest =
            std::max_element(images.begin(), images.end(), [](const auto& a, const auto& b) {
                return a->texels.size() < b->texels.size();
            });
        const auto index = static_cast<std::size_t>(largest - images.begin());
        if ((*largest)->texels.size() == 1) {
            break;
        }
        *largest = std::make_shared<const TextureImage>(halved(**largest, srgb[index]));
        result.halvings = std::max(result.halvings, ++times[index]);
    }
    return result;
}

TextureTable make_texture_table(Device& device, const Scene& scene) {
    const bool shines =
        std::any_of(scene.materials.begin(), scene.materials.end(), [](const Material& material) {
            return (material.texture_bits & material_emissive_texture) != 0;
        });
    const std::uint64_t most = device.info().limits.storage_range / sizeof(std::uint32_t) -
                               srgb_codes - (shines ? most_texel_tree_words : 0);
    const FittingImages fitting = fitting_images(scene, most);
    const auto& images = fitting.images;
    TextureTable table;
    table.halvings = fitting.halvings;
    std::vector<std::uint32_t> texels;
    texels.reserve(srgb_codes);
    for (const double value : linear_values()) {
        texels.push_back(std::bit_cast<std::uint32_t>(static_cast<float>(value)));
    }
    std::vector<TextureRecord> records;
    records.reserve(scene.textures.size());
    for (const Texture& texture : scene.textures) {
        records.push_back(record_of(texture, *images[texture.image]));
    }
    for (const Material& material : scene.materials) {
        for (std::uint32_t i = 0; i < material.texture_count; ++i) {
            const std::uint32_t index = material.first_texture + i;
            if (has_mips(scene, material, scene.textures[index]) &&
                images[scene.textures[index].image]->texels.size() > 1) {
                records[index].flags |= texture_mips;
            }
        }
        if ((material.texture_bits & material_other_textures) != 0) {
            records[material.first_texture + material.texture_count - 1].flags |= texture_last;
        }
    }
    if (shines) {
        table.trees = make_texel_trees(scene, images, records, texels);
    }
    const std::vector<bool> mips = have_mips(scene);
    std::vector<std::uint32_t> first;
    first.reserve(images.size());
    std::vector<std::vector<std::uint32_t>> levels(images.size());
    for_each_on_all_cores(images.size(), [&](std::size_t i) {
        if (mips[i]) {
            levels[i] = mip_words(*images[i]);
        }
    });
    for (std::size_t i = 0; i < images.size(); ++i) {
        first.push_back(static_cast<std::uint32_t>(texels.size()));
        texels.insert(texels.end(), images[i]->texels.begin(), images[i]->texels.end());
        texels.insert(texels.end(), levels[i].begin(), levels[i].end());
    }
    for (std::size_t i = 0; i < records.size(); ++i) {
        records[i].first = first[scene.textures[i].image];
    }
    table.records = upload(device, "textures", records);
    table.texels = upload(device, "texels", texels);
    return table;
}

std::uint32_t first_tangent(const Scene& scene) {
    return static_cast<std::uint32_t>(scene.positions.size()) * attributes_of_vertex(scene);
}

std::uint32_t attributes_of_vertex(const Scene& scene) {
    return scene.uv_sets + (scene.colors.empty() ? 0u : 1u);
}

Buffer upload_attributes(Device& device, const Scene& scene) {
    std::vector<glm::uvec2> attributes;
    attributes.reserve(first_tangent(scene) + 2 * scene.tangents.size());
    for (std::size_t vertex = 0; vertex < scene.positions.size(); ++vertex) {
        for (std::size_t set = 0; set < scene.uv_sets; ++set) {
            attributes.push_back(glm::floatBitsToUint(scene.uvs[vertex * scene.uv_sets + set]));
        }
        if (!scene.colors.empty()) {
            attributes.push_back(std::bit_cast<glm::uvec2>(scene.colors[vertex]));
        }
    }
    for (const glm::uvec3& tangents : scene.tangents) {
        attributes.emplace_back(tangents.x, tangents.y);
        attributes.emplace_back(tangents.z, 0u);
    }
    return upload(device, "attributes", attributes);
}

} // namespace argand
