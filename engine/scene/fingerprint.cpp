#include "scene/fingerprint.hpp"

#include "scene/material_record.hpp"
#include "shared/material_record.h"

namespace argand {

namespace {

template <class T> std::uint64_t with(std::uint64_t before, const T& value) {
    return fingerprint(std::as_bytes(std::span(&value, 1)), before);
}

} // namespace

std::uint64_t fingerprint(const Scene& scene, std::uint64_t before) {
    std::uint64_t hash = before;
    const auto add = [&](const auto& values) {
        hash = fingerprint(std::as_bytes(std::span(values)), hash);
    };
    add(scene.positions);
    add(scene.normals);
    add(scene.triangles);
    add(scene.triangle_material);
    add(scene.uvs);
    add(scene.colors);
    add(scene.tangents);
    if (scene.sky) {
        hash = with(hash, *scene.sky);
    } else if (scene.environment) {
        hash = with(hash, fingerprint(*scene.environment));
    }
    return hash;
}

std::uint64_t picture_fingerprint(const Scene& scene, std::size_t camera) {
    std::uint64_t hash = fingerprint(scene);
    for (const Material& material : scene.materials) {
        hash = with(with(hash, material_record(material)), material.priority);
    }
    for (const Texture& texture : scene.textures) {
        const TextureImage& image = *scene.images[texture.image];
        hash = fingerprint(std::as_bytes(std::span(image.texels)), hash);
        hash = with(with(with(hash, image.width), texture.uv_set), texture.transform);
        hash = with(with(hash, texture.wrap_u), texture.wrap_v);
        hash = with(with(with(hash, texture.nearest), texture.mips), texture.srgb);
        hash = with(with(hash, texture.use), texture.scale);
    }
    for (const Light& light : scene.lights) {
        hash = with(with(with(hash, light.kind), light.position), light.direction);
        hash =
            with(with(with(hash, light.intensity), light.inner_cone_angle), light.outer_cone_angle);
    }
    hash = with(hash, scene.sky.value_or(glm::vec3(0)));
    const Camera& c = scene.cameras[camera];
    hash = with(with(with(with(with(hash, c.kind), c.position), c.right), c.up), c.forward);
    return with(with(hash, c.vertical_angle), c.vertical_extent);
}

} // namespace argand
