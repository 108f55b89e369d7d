#include "scene/gltf_morph.hpp"

#include "scene/direction.hpp"
#include <algorithm>
#include <cmath>
#include <map>

namespace argand {
namespace {

/// The mesh that a node shows, or null.
const tinygltf::Mesh* mesh_of(const GltfSource& source, int node) {
    const int mesh = source.model.nodes[std::size_t(node)].mesh;
    return mesh >= 0 && std::size_t(mesh) < source.model.meshes.size()
               ? &source.model.meshes[std::size_t(mesh)]
               : nullptr;
}

/// One attribute of a morph target at these vertices; empty if the target does not have it.
std::vector<glm::vec3> read_differences(const GltfSource& source,
                                        const std::map<std::string, int>& target,
                                        const char* attribute_name, std::size_t count,
                                        const std::vector<std::size_t>& vertices,
                                        const std::string& what) {
    const auto found = target.find(attribute_name);
    if (found == target.end()) {
        return {};
    }
    const GltfAccessor accessor = open_accessor(source, found->second, what);
    if (!is_attribute_type(accessor) || accessor.count != count) {
        source.fail("{} are {} vectors of {} numbers; they must be {} of 3", what, accessor.count,
                    accessor.components, count);
    }
    std::vector<glm::vec3> differences;
    differences.reserve(vertices.size());
    for (const std::size_t vertex : vertices) {
        differences.emplace_back(read_vec3(accessor, vertex));
        if (!is_finite(differences.back())) {
            source.fail("vector {} of {} is not finite", vertex, what);
        }
    }
    return differences;
}

} // namespace

std::size_t morph_target_count(const GltfSource& source, int node) {
    const tinygltf::Mesh* mesh = mesh_of(source, node);
    if (!mesh || mesh->primitives.empty()) {
        return 0;
    }
    const std::size_t count = mesh->primitives.front().targets.size();
    for (const tinygltf::Primitive& primitive : mesh->primitives) {
        if (primitive.targets.size() != count) {
            source.fail("the primitives of {} have {} and {} morph targets",
                        label("mesh", source.model.nodes[std::size_t(node)].mesh, mesh->name),
                        count, primitive.targets.size());
        }
    }
    return count;
}

std::vector<double> rest_weights(const GltfSource& source, int node) {
    const std::size_t count = morph_target_count(source, node);
    const tinygltf::Node& stated = source.model.nodes[std::size_t(node)];
    if (count == 0) {
        return {};
    }
    std::vector<double> weights =
        stated.weights.empty() ? mesh_of(source, node)->weights : stated.weights;
    if (weights.empty()) {
        weights.resize(count, 0.0);
    }
    if (weights.size() != count) {
        source.fail("{} has {} morph weights for {} targets", label("node", node, stated.name),
                    weights.size(), count);
    }
    for (const double weight : weights) {
        if (!std::isfinite(weight)) {
            source.fail("{} has a morph weight that is not finite",
                        label("node", node, stated.name));
        }
    }
    return weights;
}

std::vector<MorphTarget> read_morph_targets(const GltfSource& source,
                                            const tinygltf::Primitive& primitive,
                                            const Surface& surface,
                                            const std::vector<std::size_t>& vertices,
                                            const std::string& name, std::size_t& vectors_left) {
    constexpr std::size_t attributes = 2;
    const std::size_t each = attributes * std::max<std::size_t>(vertices.size(), 1);
    if (primitive.targets.size() > vectors_left / each) {
        source.fail("its morph targets have more than {} vectors", most_morph_vectors);
    }
    vectors_left -= primitive.targets.size() * each;
    std::vector<MorphTarget> targets;
    targets.reserve(primitive.targets.size());
    for (std::size_t i = 0; i < primitive.targets.size(); ++i) {
        const auto read = [&](const char* attribute_name, const char* what) {
            return read_differences(source, primitive.targets[i], attribute_name,
                                    surface.positions.count, vertices,
                                    fmt::format("the {} of morph target {} of {}", what, i, name));
        };
        targets.push_back({read("POSITION", "positions"), surface.has_normals
                                                              ? read("NORMAL", "normals")
                                                              : std::vector<glm::vec3>()});
    }
    return targets;
}

} // namespace argand
