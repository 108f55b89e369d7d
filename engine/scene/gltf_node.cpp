#include "scene/gltf_node.hpp"

#include "scene/direction.hpp"
#include "scene/find_named.hpp"
#include "scene/gltf_instances.hpp"
#include "scene/gltf_morph.hpp"
#include "scene/pose.hpp"
#include <algorithm>
#include <cmath>
#include <fmt/ranges.h>
#include <utility>

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

glm::dvec3 vector_or(const std::vector<double>& numbers, const glm::dvec3& otherwise) {
    return numbers.empty() ? otherwise : glm::dvec3(numbers[0], numbers[1], numbers[2]);
}

LocalTransform rest_transform(const GltfSource& source, int index) {
    const tinygltf::Node& node = source.model.nodes[std::size_t(index)];
    check_length(source, index, "matrix", node.matrix, 16);
    check_length(source, index, "translation", node.translation, 3);
    check_length(source, index, "rotation", node.rotation, 4);
    check_length(source, index, "scale", node.scale, 3);
    LocalTransform local{.matrix = {},
                         .translation = vector_or(node.translation, glm::dvec3(0)),
                         .scale = vector_or(node.scale, glm::dvec3(1))};
    if (!node.matrix.empty()) {
        local.matrix = glm::dmat4(1);
        for (int i = 0; i < 16; ++i) {
            (*local.matrix)[i / 4][i % 4] =
                node.matrix[std::size_t(i)]; // column-major, in glTF as in GLM
        }
        local.translation = glm::dvec3((*local.matrix)[3]); // which edits may replace
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

/// The scene of this name or index.
int find_scene(const GltfSource& source, const std::string& choice) {
    const std::vector<tinygltf::Scene>& scenes = source.model.scenes;
    if (const std::optional<std::size_t> index = find_named(scenes, choice)) {
        return static_cast<int>(*index);
    }
    std::vector<std::string> names;
    for (std::size_t i = 0; i < std::min<std::size_t>(scenes.size(), 8); ++i) {
        names.push_back(label("scene", static_cast<int>(i), scenes[i].name));
    }
    source.fail("it has no scene '{}'; it has {}{}", one_line(choice, 60),
                names.empty() ? "none" : fmt::format("{}", fmt::join(names, ", ")),
                names.size() < scenes.size() ? ", ..." : "");
}

std::vector<int> root_nodes(const GltfSource& source, const std::string& choice) {
    const tinygltf::Model& model = source.model;
    const int scene = choice.empty() ? model.defaultScene : find_scene(source, choice);
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

std::vector<GltfNode> read_nodes(const GltfSource& source, const std::string& choice,
                                 std::vector<NodeKeys> keys, Scene& scene) {
    const std::vector<tinygltf::Node>& nodes = source.model.nodes;
    std::vector<GltfNode> flat;
    std::vector<bool> seen(nodes.size(), false);
    struct Waiting {
        int index, parent;
    };
    std::vector<Waiting> waiting; // an explicit stack, because files may nest arbitrarily deep
    const auto push = [&](const std::vector<int>& indices, int parent) {
        for (auto i = indices.rbegin(); i != indices.rend(); ++i) {
            waiting.push_back({*i, parent});
        }
    };
    std::size_t weights_left = most_morph_weights, instances_left = most_instances;
    push(root_nodes(source, choice), -1);
    while (!waiting.empty()) {
        const auto [index, parent] = waiting.back();
        waiting.pop_back();
        if (index < 0 || std::size_t(index) >= nodes.size()) {
            source.fail("its scene refers to node {}, which does not exist", index);
        }
        if (seen[std::size_t(index)]) {
            source.fail("{} is reached twice: it has two parents, or is its own ancestor",
                        label("node", index, nodes[std::size_t(index)].name));
        }
        seen[std::size_t(index)] = true;
        push(nodes[std::size_t(index)].children, static_cast<int>(flat.size()));
        if (morph_target_count(source, index) > weights_left) {
            source.fail("its nodes have more than {} morph weights", most_morph_weights);
        }
        std::vector<double> weights = rest_weights(source, index);
        weights_left -= weights.size();
        const std::vector<LocalTransform> places =
            read_instances(source, index, instances_left, scene);
        if (weights.size() * places.size() > weights_left) {
            source.fail("its nodes have more than {} morph weights", most_morph_weights);
        }
        weights_left -= weights.size() * places.size();
        const auto number = static_cast<int>(flat.size());
        const NodeKeys of_instances{.weights = keys[std::size_t(index)].weights};
        flat.push_back({index, glm::dmat4(1), false, !places.empty()});
        const std::string name = one_line(nodes[std::size_t(index)].name);
        const bool movable = source.options.movable_nodes;
        scene.motion.nodes.push_back({.index = static_cast<std::uint32_t>(index),
                                      .name = name,
                                      .parent = parent,
                                      .rest = rest_transform(source, index),
                                      .weights = weights,
                                      .keys = std::move(keys[std::size_t(index)]),
                                      .movable = movable});
        for (const LocalTransform& place : places) {
            flat.push_back({index, glm::dmat4(1), false, false, true});
            scene.motion.nodes.push_back({.index = static_cast<std::uint32_t>(index),
                                          .name = name,
                                          .parent = number,
                                          .rest = place,
                                          .weights = weights,
                                          .keys = of_instances});
        }
    }
    const Pose rest = pose_at(scene.motion, {});
    const std::vector<bool> moves = moving_nodes(scene.motion);
    for (std::size_t i = 0; i < flat.size(); ++i) {
        flat[i].to_world = rest.world_from_node[i];
        flat[i].moves = moves[i];
    }
    return flat;
}

void check_position(const GltfSource& source, const glm::vec3& position, const std::string& what) {
    if (!is_finite(position)) {
        source.fail("{} has a position that is not finite", what);
    }
}

} // namespace argand
