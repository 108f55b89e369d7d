#include "scene/gltf_material.hpp"

#include "scene/factors.hpp"
#include "scene/gltf_texture.hpp"
#include "scene/gltf_value.hpp"
#include "shared/texture_record.h"
#include <algorithm>
#include <array>
#include <limits>
#include <set>
#include <string_view>
#include <utility>

namespace argand {
namespace {

using nlohmann::json;

/// Reads a material's factors, clamped to their ranges.
struct FactorReader {
    const GltfSource& source;
    Scene& scene;
    std::string what;

    float in_range(double value, double low, double high, const char* key) const {
        // NaN cannot occur: JSON cannot represent it.
        if (value < low || value > high) {
            const double nearest = std::clamp(value, low, high);
            add_note(scene, fmt::format("{} has a {} of {}, which is out of range; {} is used",
                                        what, key, value, nearest));
            value = nearest;
        }
        return static_cast<float>(value);
    }

    glm::vec3 in_range(const glm::dvec3& value, double high, const char* key) const {
        return {in_range(value.x, 0, high, key), in_range(value.y, 0, high, key),
                in_range(value.z, 0, high, key)};
    }

    float number(const json* object, const char* key, double otherwise, double high) const {
        return in_range(number_of(source, object, key, otherwise, what), 0, high, key);
    }
};

constexpr double unlimited = std::numeric_limits<float>::max();

/// Collects the textures that the material and its extensions refer to, by their keys.
void list_textures(const json& value, std::set<std::string>& keys) {
    for (const auto& [key, member] : value.items()) {
        if (member.is_object() && key.ends_with("Texture")) {
            keys.insert(key);
        } else if (member.is_object()) {
            list_textures(member, keys);
        }
    }
}

/// Textures that are read, or that rendering does not need.
bool is_read(const std::string& texture) {
    constexpr std::array<std::string_view, 17> known{
        "baseColorTexture",          "metallicRoughnessTexture",
        "emissiveTexture",           "normalTexture",
        "occlusionTexture",          "specularTexture",
        "specularColorTexture",      "transmissionTexture",
        "thicknessTexture",          "clearcoatTexture",
        "clearcoatRoughnessTexture", "clearcoatNormalTexture",
        "iridescenceTexture",        "iridescenceThicknessTexture",
        "sheenColorTexture",         "sheenRoughnessTexture",
        "anisotropyTexture"};
    return std::find(known.begin(), known.end(), texture) != known.end();
}

void read_alpha(const FactorReader& read, const tinygltf::Material& from,
                MaterialFactors& factors) {
    if (from.alphaMode == "OPAQUE") {
        return;
    }
    const double alpha = from.pbrMetallicRoughness.baseColorFactor[3];
    factors.base_color.a = read.in_range(alpha, 0, 1, "alpha");
    if (from.alphaMode == "BLEND") {
        factors.alpha_mode = AlphaMode::blend;
    } else if (from.alphaMode == "MASK") {
        factors.alpha_mode = AlphaMode::mask;
        factors.alpha_cutoff = read.in_range(from.alphaCutoff, 0, unlimited, "alphaCutoff");
    } else {
        read.source.fail("{} has the alphaMode \"{}\"; it must be OPAQUE, MASK or BLEND", read.what,
                         one_line(from.alphaMode, 60));
    }
}

void read_core(const FactorReader& read, const tinygltf::Material& from, MaterialFactors& factors) {
    const tinygltf::PbrMetallicRoughness& pbr = from.pbrMetallicRoughness;
    // Tinygltf ensures that it has 4 elements.
    const std::vector<double>& color = pbr.baseColorFactor;
    factors.base_color = glm::dvec4(
        read.in_range(glm::dvec3(color[0], color[1], color[2]), 1, "baseColorFactor"), 1);
    factors.metallic = read.in_range(pbr.metallicFactor, 0, 1, "metallicFactor");
    factors.roughness = read.in_range(pbr.roughnessFactor, 0, 1, "roughnessFactor");
    read_alpha(read, from, factors);
}

void read_emission(const FactorReader& read, const tinygltf::Material& from, const json* object,
                   MaterialFactors& factors) {
    factors.emissive_strength =
        read.number(find_extension(object, "KHR_materials_emissive_strength"), "emissiveStrength",
                    1, unlimited);
    const glm::dvec3 factor(from.emissiveFactor[0], from.emissiveFactor[1], from.emissiveFactor[2]);
    factors.emissive = read.in_range(factor, unlimited, "emissiveFactor");
    read.in_range(factors.emissive * factors.emissive_strength, unlimited, "emission"); // its note
}

/// Throws Error for an index of refraction that is neither 0 nor at least 1.
void read_extensions(const FactorReader& read, const json* object, MaterialFactors& factors) {
    const json* specular = find_extension(object, "KHR_materials_specular");
    factors.specular = read.number(specular, "specularFactor", 1, 1);
    factors.specular_color = read.in_range(
        vector_of(read.source, specular, "specularColorFactor", glm::dvec3(1), read.what),
        unlimited, "specularColorFactor");
    factors.transmission = read.number(find_extension(object, "KHR_materials_transmission"),
                                       "transmissionFactor", 0, 1);
    const json* volume = find_extension(object, "KHR_materials_volume");
    factors.thickness = read.number(volume, "thicknessFactor", 0, unlimited);
    factors.attenuation_color =
        read.in_range(vector_of(read.source, volume, "attenuationColor", glm::dvec3(1), read.what),
                      1, "attenuationColor");
    if (find_member(volume, "attenuationDistance")) {
        factors.attenuation_distance =
            number_of(read.source, volume, "attenuationDistance", 0, read.what);
        if (!(factors.attenuation_distance > 0)) {
            read.source.fail("{} has an attenuationDistance of {}; it must be above 0", read.what,
                             factors.attenuation_distance);
        }
    }
    const json* coat = find_extension(object, "KHR_materials_clearcoat");
    factors.coat = read.number(coat, "clearcoatFactor", 0, 1);
    factors.coat_roughness = read.number(coat, "clearcoatRoughnessFactor", 0, 1);
    factors.dispersion =
        read.number(find_extension(object, "KHR_materials_dispersion"), "dispersion", 0, unlimited);
    const json* sheen = find_extension(object, "KHR_materials_sheen");
    factors.sheen_color =
        read.in_range(vector_of(read.source, sheen, "sheenColorFactor", glm::dvec3(0), read.what),
                      1, "sheenColorFactor");
    factors.sheen_roughness = read.number(sheen, "sheenRoughnessFactor", 0, 1);
    const json* anisotropy = find_extension(object, "KHR_materials_anisotropy");
    factors.anisotropy = read.number(anisotropy, "anisotropyStrength", 0, 1);
    factors.anisotropy_rotation =
        number_of(read.source, anisotropy, "anisotropyRotation", 0, read.what);
    const json* film = find_extension(object, "KHR_materials_iridescence");
    factors.iridescence = read.number(film, "iridescenceFactor", 0, 1);
    factors.iridescence_ior =
        read.in_range(number_of(read.source, film, "iridescenceIor", 1.3, read.what), 1, unlimited,
                      "iridescenceIor");
    // Without a texture the film has its greatest thickness everywhere.
    factors.iridescence_thickness =
        read.number(film, "iridescenceThicknessMaximum", 400, unlimited);
    factors.unlit = find_extension(object, "KHR_materials_unlit") != nullptr;
    factors.ior =
        number_of(read.source, find_extension(object, "KHR_materials_ior"), "ior", 1.5, read.what);
    // In glTF an index of 0 means that the Fresnel term is 1.
    if (factors.ior != 0 && !(factors.ior >= 1 && factors.ior <= unlimited)) {
        read.source.fail("{} has an index of refraction of {}; it must be 0 or at least 1",
                         read.what, factors.ior);
    }
}

/// "extras": {"phong": {"specular": [r, g, b], "exponent": n}}; both members are required.
void read_phong(const FactorReader& read, const json* object, Material& material) {
    const json* phong = find_member(find_member(object, "extras"), "phong");
    if (!phong) {
        return;
    }
    const std::string what = read.what + "'s \"phong\"";
    for (const char* key : {"specular", "exponent"}) {
        if (!find_member(phong, key)) {
            read.source.fail("{} is not an object with a \"specular\" and an \"exponent\"", what);
        }
    }
    const glm::dvec3 specular = vector_of(read.source, phong, "specular", glm::dvec3(0), what);
    const double exponent = number_of(read.source, phong, "exponent", 0, what);
    if (!(exponent >= 0 && exponent <= unlimited)) {
        read.source.fail("{} has an exponent of {}; it must be at least 0", what, exponent);
    }
    for (int channel = 0; channel < 3; ++channel) {
        const double sum = specular[channel] + double(material.base_color[channel]);
        if (!(specular[channel] >= 0 && sum <= 1 + 1e-6)) {
            read.source.fail("{} has a specular colour of {} beside a base colour of {:.6g}; it "
                             "must be at least 0, "
                             "and their sum at most 1",
                             what, specular[channel], material.base_color[channel]);
        }
    }
    if (material.transmission > 0) {
        add_note(read.scene, fmt::format("{} is Phong: its transmission is ignored", read.what));
    }
    material.phong = Phong{glm::vec3(specular), static_cast<float>(exponent)};
}

/// "extras": {"priority": number}, for solids that overlap. Other programs may mean another thing.
void read_priority(const FactorReader& read, const json* object, Material& material) {
    const json* priority = find_member(find_member(object, "extras"), "priority");
    if (!priority) {
        return;
    }
    if (!priority->is_number() || !(std::abs(priority->get<double>()) <= unlimited)) {
        add_note(read.scene, fmt::format("{} has a \"priority\" that is not a number in range, "
                                         "and is ignored",
                                         read.what));
        return;
    }
    material.priority = priority->get<float>();
}

/// What a material may have now or at another time, so that textures may change it.
struct TextureNeeds {
    bool emission, specular, transmission, thickness, coat, film, sheen, anisotropy;
};

TextureNeeds needs_of(const MaterialFactors& factors, const MaterialKeys& keys) {
    return {.emission = factors.emissive * factors.emissive_strength != glm::dvec3(0) ||
                        keys.emissive || keys.emissive_strength,
            .specular = factors.specular > 0 || keys.specular,
            .transmission = factors.transmission > 0 || keys.transmission,
            .thickness = factors.thickness > 0 || keys.thickness,
            .coat = factors.coat > 0 || keys.coat,
            .film = factors.iridescence > 0 || keys.iridescence,
            .sheen = factors.sheen_color != glm::dvec3(0) || keys.sheen_color,
            .anisotropy = factors.anisotropy > 0 || keys.anisotropy};
}

/// Adds a texture, or if it changes nothing only checks it.
void read_texture(TextureReader& textures, const json* owner, const char* key, TextureUse use,
                  bool needed, std::uint32_t bit, const std::string& what, Material& material,
                  float scale = 1) {
    if (!needed) {
        textures.check(owner, key, what);
    } else if (textures.add(owner, key, use, what, scale)) {
        material.texture_bits |= bit;
        ++material.texture_count;
    }
}

float normal_scale(const FactorReader& read, const json* owner, const char* key) {
    const std::string what = fmt::format("{}, {}", read.what, key);
    const double scale = number_of(read.source, find_member(owner, key), "scale", 1, what);
    return read.in_range(scale, -unlimited, unlimited, (std::string(key) + "'s scale").c_str());
}

/// A coat's normals follow its own texture; without one they stay as they are where a texture turns
/// those of the surface.
void add_coat_normal(TextureReader& textures, const FactorReader& read, const json* coat,
                     bool needed, Material& material) {
    const float scale = normal_scale(read, coat, "clearcoatNormalTexture");
    const std::uint32_t before = material.texture_count;
    read_texture(textures, coat, "clearcoatNormalTexture", TextureUse::coat_normal,
                 needed && scale != 0, material_other_textures, read.what, material, scale);
    material.coat_has_normal = needed && (material.texture_count > before ||
                                          (material.texture_bits & material_normal_texture) != 0);
}

/// Adds the textures of a material.
void read_textures(TextureReader& textures, const FactorReader& read, const json* object,
                   const TextureNeeds& needs, Material& material) {
    material.first_texture = static_cast<std::uint32_t>(read.scene.textures.size());
    const auto add = [&](const json* owner, const char* key, TextureUse use, bool needed,
                         std::uint32_t bit, float scale = 1) {
        read_texture(textures, owner, key, use, needed, bit, read.what, material, scale);
    };
    const json* pbr = find_member(object, "pbrMetallicRoughness");
    const bool has_metal = !material.phong; // and a dielectric's layer
    add(pbr, "baseColorTexture", TextureUse::base_color, true, material_base_color_texture);
    add(pbr, "metallicRoughnessTexture", TextureUse::metallic_roughness, has_metal,
        material_metal_texture);
    add(object, "emissiveTexture", TextureUse::emissive, needs.emission, material_emissive_texture);
    const float scale = normal_scale(read, object, "normalTexture");
    add(object, "normalTexture", TextureUse::normal, scale != 0, material_normal_texture, scale);
    const json* specular = find_extension(object, "KHR_materials_specular");
    add(specular, "specularTexture", TextureUse::specular, has_metal && needs.specular,
        material_other_textures);
    add(specular, "specularColorTexture", TextureUse::specular_color, has_metal && needs.specular,
        material_other_textures);
    const bool transmits = has_metal && needs.transmission;
    add(find_extension(object, "KHR_materials_transmission"), "transmissionTexture",
        TextureUse::transmission, transmits, material_other_textures);
    add(find_extension(object, "KHR_materials_volume"), "thicknessTexture", TextureUse::thickness,
        transmits && needs.thickness, material_other_textures);
    const json* coat = find_extension(object, "KHR_materials_clearcoat");
    add(coat, "clearcoatTexture", TextureUse::coat, has_metal && needs.coat,
        material_other_textures);
    add(coat, "clearcoatRoughnessTexture", TextureUse::coat_roughness, has_metal && needs.coat,
        material_other_textures);
    add_coat_normal(textures, read, coat, has_metal && needs.coat, material);
    const json* film = find_extension(object, "KHR_materials_iridescence");
    add(film, "iridescenceTexture", TextureUse::film, has_metal && needs.film,
        material_other_textures);
    const json* sheen = find_extension(object, "KHR_materials_sheen");
    add(sheen, "sheenColorTexture", TextureUse::sheen_color, has_metal && needs.sheen,
        material_other_textures);
    add(sheen, "sheenRoughnessTexture", TextureUse::sheen_roughness, has_metal && needs.sheen,
        material_other_textures);
    add(find_extension(object, "KHR_materials_anisotropy"), "anisotropyTexture",
        TextureUse::anisotropy, has_metal && needs.anisotropy, material_other_textures);
    const double most = number_of(read.source, film, "iridescenceThicknessMaximum", 400, read.what);
    const double least =
        number_of(read.source, film, "iridescenceThicknessMinimum", 100, read.what);
    add(film, "iridescenceThicknessTexture", TextureUse::film_thickness, has_metal && needs.film,
        material_other_textures,
        most > 0 ? static_cast<float>(std::clamp(least / most, 0.0, 1000.0)) : 1.0f);
    textures.check(object, "occlusionTexture", read.what); // its effect is that of the light paths
    if (material.texture_bits == 0) {
        material.first_texture = 0;
    }
    std::set<std::string> keys;
    if (object) {
        list_textures(*object, keys);
    }
    std::erase_if(keys, is_read);
    for (const std::string& key : keys) {
        add_note(read.scene,
                 fmt::format("{} is not read yet: the factors of the materials are used",
                             one_line(key, 60)));
    }
}

/// Alpha of texels counts where some of them have less than 1.
void find_varying_alpha(Scene& scene) {
    for (Material& material : scene.materials) {
        const bool colored = (material.texture_bits & material_base_color_texture) != 0;
        material.alpha_varies =
            colored && material.alpha_mode != AlphaMode::opaque &&
            scene.images[scene.textures[material.first_texture].image]->low.a < 255;
    }
}

} // namespace

void add_materials(const GltfSource& source, std::vector<MaterialKeys> keys, Scene& scene) {
    TextureReader textures(source, scene);
    for (std::size_t i = 0; i < source.model.materials.size(); ++i) {
        const tinygltf::Material& from = source.model.materials[i];
        const json* object = find_element(source, "materials", i);
        const FactorReader read{source, scene, label("material", static_cast<int>(i), from.name)};
        MaterialFactors factors;
        read_core(read, from, factors);
        read_emission(read, from, object, factors);
        read_extensions(read, object, factors);
        Material material;
        material.name = one_line(from.name);
        material.double_sided = from.doubleSided;
        set_factors(factors, material);
        read_phong(read, object, material);
        const TextureNeeds needs = needs_of(factors, keys[i]);
        if (needs.thickness) {
            read_priority(read, object, material);
        }
        read_textures(textures, read, object, needs, material);
        if (needs.anisotropy) {
            scene.uv_sets = std::max(scene.uv_sets, 1u); // tangents may follow the first
        }
        scene.materials.push_back(material);
        if (keys[i].moves()) {
            scene.motion.materials.push_back({i, factors, std::move(keys[i])});
        }
    }
    textures.decode_images();
    find_varying_alpha(scene);
}

} // namespace argand
