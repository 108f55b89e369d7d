#include "scene/gltf_surface.hpp"

#include "scene/tangents.hpp"

namespace argand {

bool is_attribute_type(const GltfAccessor& accessor) {
    return accessor.components == 3 &&
           accessor.component_type != TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT;
}

std::size_t triangle_count(int mode, std::size_t corners) {
    if (mode == TINYGLTF_MODE_TRIANGLES) {
        return corners / 3;
    }
    return corners < 3 ? 0 : corners - 2;
}

glm::uvec3 triangle_corners(int mode, std::uint32_t i) {
    switch (mode) {
    case TINYGLTF_MODE_TRIANGLE_STRIP:
        return {i, i + 1 + i % 2, i + 2 - i % 2};
    case TINYGLTF_MODE_TRIANGLE_FAN:
        return {i + 1, i + 2, 0};
    default:
        return {3 * i, 3 * i + 1, 3 * i + 2};
    }
}

int attribute(const tinygltf::Primitive& primitive, const char* name) {
    const auto found = primitive.attributes.find(name);
    return found == primitive.attributes.end() ? -1 : found->second;
}

bool open_surface(const GltfSource& source, const tinygltf::Primitive& primitive,
                  const std::string& name, Surface& surface, Scene& scene) {
    surface.mode = primitive.mode;
    if (surface.mode < TINYGLTF_MODE_POINTS || surface.mode > TINYGLTF_MODE_TRIANGLE_FAN) {
        source.fail("{} has a primitive of mode {}, which glTF does not know", name, surface.mode);
    }
    if (surface.mode < TINYGLTF_MODE_TRIANGLES) {
        add_note(scene, "points and lines are not rendered");
        return false;
    }
    if (attribute(primitive, "POSITION") < 0) {
        add_note(scene,
                 fmt::format("{} has a primitive without positions; it is not rendered", name));
        return false;
    }
    surface.positions =
        open_accessor(source, attribute(primitive, "POSITION"), "the positions of " + name);
    if (!is_attribute_type(surface.positions)) {
        source.fail(
            "the positions of {} are not three-component vectors of a type that glTF allows", name);
    }
    surface.has_normals = attribute(primitive, "NORMAL") >= 0;
    if (surface.has_normals) {
        surface.normals =
            open_accessor(source, attribute(primitive, "NORMAL"), "the normals of " + name);
        if (!is_attribute_type(surface.normals)) {
            source.fail(
                "the normals of {} are not three-component vectors of a type that glTF allows",
                name);
        }
        if (surface.normals.count != surface.positions.count) {
            source.fail("{} has {} positions but {} normals", name, surface.positions.count,
                        surface.normals.count);
        }
    }
    surface.corner_count = surface.positions.count;
    surface.has_indices = primitive.indices >= 0;
    if (surface.has_indices) {
        surface.indices = open_accessor(source, primitive.indices, "the indices of " + name);
        const int type = surface.indices.component_type;
        if (surface.indices.components != 1 || (type != TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE &&
                                                type != TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT &&
                                                type != TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT)) {
            source.fail("the indices of {} are not unsigned integers", name);
        }
        surface.corner_count = surface.indices.count;
    }
    if (surface.mode == TINYGLTF_MODE_TRIANGLES && surface.corner_count % 3 != 0) {
        add_note(scene,
                 fmt::format(
                     "{} has {} corners, which is no multiple of three; the last ones are ignored",
                     name, surface.corner_count));
    }
    return triangle_count(surface.mode, surface.corner_count) > 0;
}

void open_texture_attributes(const GltfSource& source, const tinygltf::Primitive& primitive,
                             const std::string& name, std::uint32_t material, Surface& surface,
                             Scene& scene) {
    const auto open = [&](const std::string& key, const char* kind) {
        const GltfAccessor accessor = open_accessor(source, attribute(primitive, key.c_str()),
                                                    fmt::format("the {} of {}", kind, name));
        if (accessor.count != surface.positions.count) {
            source.fail("{} has {} positions but {} {}", name, surface.positions.count,
                        accessor.count, kind);
        }
        return accessor;
    };
    const auto open_uvs = [&](std::uint32_t set, const std::string& key) {
        const GltfAccessor accessor = open(key, "texture coordinates");
        if (accessor.components != 2) {
            source.fail("the texture coordinates of {} are not pairs", name);
        }
        surface.uvs.emplace_back(set, accessor);
    };
    const Material& of = scene.materials[material];
    for (std::uint32_t i = 0; i < of.texture_count; ++i) {
        const std::uint32_t set = scene.textures[of.first_texture + i].uv_set;
        const std::string key = fmt::format("TEXCOORD_{}", set);
        if (attribute(primitive, key.c_str()) < 0) {
            source.fail("{} has no {}, which a texture of {} needs", name, key,
                        label("material", static_cast<int>(material), of.name));
        }
        open_uvs(set, key);
    }
    const bool needs = needs_tangents(scene, material);
    surface.has_tangents = needs && attribute(primitive, "TANGENT") >= 0;
    if (needs && !surface.has_tangents && !tangent_texture(scene, material)) {
        if (attribute(primitive, "TEXCOORD_0") >= 0) {
            open_uvs(0, "TEXCOORD_0");
        } else {
            add_note(scene, fmt::format("{} is anisotropic but has neither tangents nor texture "
                                        "coordinates: the direction is arbitrary",
                                        name));
        }
    }
    if (surface.has_tangents) {
        surface.tangents = open("TANGENT", "tangents");
        if (surface.tangents.components != 4) {
            source.fail("the tangents of {} have {} components; they must have 4", name,
                        surface.tangents.components);
        }
    }
    surface.has_colors = attribute(primitive, "COLOR_0") >= 0;
    if (surface.has_colors) {
        surface.colors = open("COLOR_0", "colours");
        if (surface.colors.components != 3 && surface.colors.components != 4) {
            source.fail("the colours of {} have {} components; they must have 3 or 4", name,
                        surface.colors.components);
        }
    }
    if (attribute(primitive, "COLOR_1") >= 0) {
        add_note(scene, "only the first set of vertex colours is used");
    }
}

} // namespace argand
