#include "scene/gltf_instances.hpp"

#include "scene/gltf_accessor.hpp"
#include "scene/gltf_value.hpp"
#include <cmath>
#include <optional>

namespace argand {
namespace {

constexpr const char* instancing_extension = "EXT_mesh_gpu_instancing";

bool is_signed_or_float(const GltfAccessor& accessor) {
    return accessor.component_type == TINYGLTF_COMPONENT_TYPE_FLOAT ||
           (accessor.normalized && (accessor.component_type == TINYGLTF_COMPONENT_TYPE_BYTE ||
                                    accessor.component_type == TINYGLTF_COMPONENT_TYPE_SHORT));
}

/// An attribute of the instances; none if it is absent. Sets or checks their number.
std::optional<GltfAccessor> open_attribute(const GltfSource& source,
                                           const nlohmann::json& attributes, const char* key,
                                           int components, std::optional<std::size_t>& count,
                                           const std::string& what) {
    const nlohmann::json* index = find_member(&attributes, key);
    if (!index) {
        return std::nullopt;
    }
    if (!index->is_number_unsigned() || index->get<std::uint64_t>() > 0x7fffffff) {
        source.fail("{} have a {} that is no accessor", what, key);
    }
    const GltfAccessor accessor =
        open_accessor(source, index->get<int>(), fmt::format("the {} of {}", key, what));
    if (accessor.components != components || !is_signed_or_float(accessor)) {
        source.fail("{} have a {} whose type the extension does not allow", what, key);
    }
    if (count && *count != accessor.count) {
        source.fail("{} have attributes of {} and of {} elements", what, *count, accessor.count);
    }
    count = accessor.count;
    return accessor;
}

glm::dquat read_rotation(const GltfSource& source, const GltfAccessor& accessor,
                         std::size_t instance, const std::string& what) {
    const glm::dquat q(read_component(accessor, instance, 3), read_component(accessor, instance, 0),
                       read_component(accessor, instance, 1),
                       read_component(accessor, instance, 2));
    const double length = glm::length(q);
    if (!(length > 0) || !std::isfinite(length)) {
        source.fail("instance {} of {} has a rotation that is not a unit quaternion", instance,
                    what);
    }
    return q / length;
}

} // namespace

std::vector<LocalTransform> read_instances(const GltfSource& source, int node,
                                           std::size_t& instances_left, Scene& scene) {
    const tinygltf::Node& owner = source.model.nodes[std::size_t(node)];
    const nlohmann::json* extension =
        find_extension(find_element(source, "nodes", std::size_t(node)), instancing_extension);
    if (!extension || owner.mesh < 0) {
        return {};
    }
    const std::string what = "the instances of " + label("node", node, owner.name);
    if (owner.skin >= 0) {
        add_note(scene, fmt::format("{} are not shown: its mesh has a skin", what));
        return {};
    }
    const nlohmann::json* attributes = find_member(extension, "attributes");
    std::optional<std::size_t> count;
    std::optional<GltfAccessor> translations, rotations, scales;
    if (attributes && attributes->is_object()) {
        translations = open_attribute(source, *attributes, "TRANSLATION", 3, count, what);
        rotations = open_attribute(source, *attributes, "ROTATION", 4, count, what);
        scales = open_attribute(source, *attributes, "SCALE", 3, count, what);
    }
    if (!count) {
        source.fail("{} have no attribute TRANSLATION, ROTATION or SCALE", what);
    }
    if (*count > instances_left) {
        source.fail("its nodes have more than {} instances", most_instances);
    }
    instances_left -= *count;
    std::vector<LocalTransform> places(*count);
    for (std::size_t i = 0; i < places.size(); ++i) {
        if (translations) {
            places[i].translation = read_vec3(*translations, i);
        }
        if (rotations) {
            places[i].rotation = read_rotation(source, *rotations, i, what);
        }
        if (scales) {
            places[i].scale = read_vec3(*scales, i);
        }
    }
    return places;
}

} // namespace argand
