#include "scene/gltf_node.hpp"

#include "scene/direction.hpp"
#include <cmath>
#include <glm/gtc/quaternion.hpp>

namespace argand {
namespace {

void check_length(const GltfSource& source, int index, const char* what,
                  const std::vector<double>& numbers, std::size_t length) {
    if (!numbers.empty() && numbers.size() != length) {
        source.fail("{} has a {} that is not {} numbers",
                    label("node", index, source.model.nodes[std::size_t(index)].name), what,
                    length);
    }
}

/// A node's transform relative to its parent, as the file states it at rest.
struct LocalTransform {
    std::optional<glm::dmat4> matrix; ///< instead of the others
    std::optional<glm::dquat> rotation;
    std::vector<double> translation, scale; ///< three numbers, or none
};

LocalTransform rest_transform(const GltfSource& source, int index) {
    const tinygltf::Node& node = source.model.nodes[std::size_t(index)];
    check_length(source, index, "matrix", node.matrix, 16);
    check_length(source, index, "translation", node.translation, 3);
    check_length(source, index, "rotation", node.rotation, 4);
    check_length(source, index, "scale", node.scale, 3);
    LocalTransform local{
        .matrix = {}, .rotation = {}, .translation = node.translation, .scale = node.scale};
    if (!node.matrix.empty()) {
        local.matrix = glm::dmat4(1);
        for (int i = 0; i < 16; ++i) {
            (*local.matrix)[i / 4][i % 4] =
                node.matrix[std::size_t(i)]; // column-major, in glTF as in GLM
        }
    }
    if (!node.rotation.empty()) {
        const std::vector<double>& r = node.rotation;
        const double length = std::sqrt(r[0] * r[0] + r[1] * r[1] + r[2] * r[2] + r[3] * r[3]);
        if (node.matrix.empty() && (!(length > 0) || !std::isfinite(length))) {
            source.fail("{} has a rotation that is not a unit quaternion",
                        label("node", index, node.name));
        }
        local.rotation = glm::dquat(r[3] / length, r[0] / length, r[1] / length, r[2] / length);
    }
    return local;
}

void pose(LocalTransform& local, const NodeKeys& keys, double seconds) {
    if (keys.translation) {
        local.translation = value_at(*keys.translation, seconds);
    }
    if (keys.rotation) {
        local.rotation = rotation_at(*keys.rotation, seconds);
    }
    if (keys.scale) {
        local.scale = value_at(*keys.scale, seconds);
    }
}

glm::dmat4 to_matrix(const LocalTransform& local) {
    if (local.matrix) {
        return *local.matrix;
    }
    glm::dmat4 transform(1);
    if (local.rotation) {
        transform = glm::mat4_cast(*local.rotation);
    }
    if (!local.scale.empty()) {
        for (int axis = 0; axis < 3; ++axis) {
            transform[axis] *= local.scale[std::size_t(axis)];
        }
    }
    if (!local.translation.empty()) {
        transform[3] =
            glm::dvec4(local.translation[0], local.translation[1], local.translation[2], 1);
    }
    return transform;
}

std::vector<int> root_nodes(const GltfSource& source) {
    const tinygltf::Model& model = source.model;
    const int scene = model.defaultScene;
    if (scene >= 0 && std::size_t(scene) >= model.scenes.size()) {
        source.fail("its default scene {} does not exist", scene);
    }
    if (!model.scenes.empty()) {
        return model.scenes[std::size_t(scene >= 0 ? scene : 0)].nodes;
    }
    std::vector<bool> is_child(model.nodes.size(), false);
    for (const tinygltf::Node& node : model.nodes) {
        for (const int child : node.children) {
            if (child >= 0 && std::size_t(child) < is_child.size()) {
                is_child[std::size_t(child)] = true;
            }
        }
    }
    std::vector<int> roots;
    for (std::size_t i = 0; i < is_child.size(); ++i) {
        if (!is_child[i]) {
            roots.push_back(static_cast<int>(i));
        }
    }
    return roots;
}

} // namespace

std::vector<GltfNode> flatten_nodes(const GltfSource& source, const std::vector<NodeKeys>& keys,
                                    std::optional<double> seconds) {
    const std::vector<tinygltf::Node>& nodes = source.model.nodes;
    std::vector<GltfNode> flat;
    std::vector<bool> seen(nodes.size(), false);
    std::vector<GltfNode> waiting; // an explicit stack, because files may nest arbitrarily deep
    const auto push = [&](const std::vector<int>& indices, const glm::dmat4& parent) {
        for (auto i = indices.rbegin(); i != indices.rend(); ++i) {
            waiting.push_back({*i, parent});
        }
    };
    push(root_nodes(source), glm::dmat4(1));
    while (!waiting.empty()) {
        const GltfNode next = waiting.back();
        waiting.pop_back();
        if (next.index < 0 || std::size_t(next.index) >= nodes.size()) {
            source.fail("its scene refers to node {}, which does not exist", next.index);
        }
        if (seen[std::size_t(next.index)]) {
            source.fail("{} is reached twice: it has two parents, or is its own ancestor",
                        label("node", next.index, nodes[std::size_t(next.index)].name));
        }
        seen[std::size_t(next.index)] = true;
        LocalTransform local = rest_transform(source, next.index);
        if (seconds) {
            pose(local, keys[std::size_t(next.index)], *seconds);
        }
        flat.push_back({next.index, next.to_world * to_matrix(local)});
        push(nodes[std::size_t(next.index)].children, flat.back().to_world);
    }
    return flat;
}

glm::vec3 position_of(const GltfSource& source, const glm::dmat4& to_world,
                      const std::string& what) {
    const glm::vec3 position{glm::dvec3(to_world[3])};
    if (!is_finite(position)) {
        source.fail("{} has a position that is not finite", what);
    }
    return position;
}

} // namespace argand
