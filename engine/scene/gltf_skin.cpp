#include "scene/gltf_skin.hpp"

#include "scene/gltf_accessor.hpp"
#include "scene/gltf_surface.hpp"
#include <algorithm>
#include <cmath>
#include <utility>

namespace argand {
namespace {

constexpr std::size_t most_sets = 16; // of four joints and four weights each

std::vector<glm::dmat4> read_matrices(const GltfSource& source, int accessor, std::size_t count,
                                      const std::string& what) {
    if (accessor < 0) {
        return std::vector<glm::dmat4>(count, glm::dmat4(1));
    }
    const GltfAccessor view = open_accessor(source, accessor, what);
    if (view.components != 16 || view.component_type != TINYGLTF_COMPONENT_TYPE_FLOAT ||
        view.count < count) {
        source.fail("{} are not {} matrices of floating-point numbers", what, count);
    }
    std::vector<glm::dmat4> matrices(count);
    for (std::size_t i = 0; i < count; ++i) {
        for (int k = 0; k < 16; ++k) {
            matrices[i][k / 4][k % 4] = read_component(view, i, k);
            if (!std::isfinite(matrices[i][k / 4][k % 4])) {
                source.fail("matrix {} of {} is not finite", i, what);
            }
        }
    }
    return matrices;
}

/// Joints and weights of one set: JOINTS_n and WEIGHTS_n.
struct JointSet {
    GltfAccessor joints, weights;
};

std::vector<JointSet> open_sets(const GltfSource& source, const tinygltf::Primitive& primitive,
                                const std::string& name) {
    std::vector<JointSet> sets;
    for (std::size_t i = 0; i < most_sets; ++i) {
        const int joints = attribute(primitive, fmt::format("JOINTS_{}", i).c_str());
        const int weights = attribute(primitive, fmt::format("WEIGHTS_{}", i).c_str());
        if (joints < 0 && weights < 0) {
            break;
        }
        sets.push_back({open_accessor(source, joints, "the joints of " + name),
                        open_accessor(source, weights, "the joint weights of " + name)});
        const JointSet& set = sets.back();
        const int type = set.joints.component_type;
        if (set.joints.components != 4 || set.joints.normalized ||
            (type != TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE &&
             type != TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT)) {
            source.fail("the joints of {} are not four small unsigned integers", name);
        }
        if (set.weights.components != 4 ||
            (set.weights.component_type != TINYGLTF_COMPONENT_TYPE_FLOAT &&
             !set.weights.normalized)) {
            source.fail("the joint weights of {} are not four floating-point or normalised numbers",
                        name);
        }
    }
    if (sets.empty()) {
        source.fail("{} has a skin, but no joints", name);
    }
    return sets;
}

/// A joint and its weight.
using Weighted = std::pair<double, std::uint32_t>;

/// The four heaviest, with weights that sum to 1.
JointWeights heaviest(std::vector<Weighted>& carried, double sum) {
    const std::size_t most = JointWeights().joints.size();
    std::stable_sort(carried.begin(), carried.end(),
                     [](const Weighted& a, const Weighted& b) { return a.first > b.first; });
    for (std::size_t k = most; k < carried.size(); ++k) {
        sum -= carried[k].first;
    }
    JointWeights result;
    for (std::size_t k = 0; k < std::min(most, carried.size()); ++k) {
        result.joints[k] = carried[k].second;
        result.weights[k] = static_cast<float>(carried[k].first / sum);
    }
    return result;
}

} // namespace

Skins::Skins(const GltfSource& source, const std::vector<GltfNode>& nodes)
    : source_(source), nodes_(nodes), number_of_node_(source.model.nodes.size(), -1) {
    for (std::size_t i = 0; i < nodes.size(); ++i) {
        if (!nodes[i].is_instance) {
            number_of_node_[std::size_t(nodes[i].index)] = static_cast<int>(i);
        }
    }
}

int Skins::number_of(int skin, Scene& scene) {
    if (std::size_t(skin) >= source_.model.skins.size()) {
        source_.fail("a node refers to skin {}, which does not exist", skin);
    }
    const auto [known, is_new] =
        known_.try_emplace(skin, static_cast<int>(scene.motion.skins.size()));
    if (!is_new) {
        return known->second;
    }
    const tinygltf::Skin& from = source_.model.skins[std::size_t(skin)];
    const std::string what = label("skin", skin, from.name);
    Skin result;
    result.joints.reserve(from.joints.size());
    for (const int joint : from.joints) {
        const bool exists = joint >= 0 && std::size_t(joint) < number_of_node_.size();
        if (!exists || number_of_node_[std::size_t(joint)] < 0) {
            source_.fail("{} has node {} as a joint, which the scene does not have", what, joint);
        }
        result.joints.push_back(static_cast<std::uint32_t>(number_of_node_[std::size_t(joint)]));
    }
    result.joint_from_mesh = read_matrices(source_, from.inverseBindMatrices, result.joints.size(),
                                           "the inverse bind matrices of " + what);
    scene.motion.skins.push_back(std::move(result));
    return known->second;
}

bool Skins::moves(int skin) const {
    const std::vector<int>& joints = source_.model.skins[std::size_t(skin)].joints;
    return std::any_of(joints.begin(), joints.end(), [&](int joint) {
        return nodes_[std::size_t(number_of_node_[std::size_t(joint)])].moves;
    });
}

std::vector<JointWeights> Skins::weights_of(int skin, const tinygltf::Primitive& primitive,
                                            const std::vector<std::size_t>& vertices,
                                            const std::string& name, Scene& scene) const {
    constexpr double most_off = 0.01;
    const std::vector<JointSet> sets = open_sets(source_, primitive, name);
    const std::size_t joints = source_.model.skins[std::size_t(skin)].joints.size();
    std::vector<JointWeights> result;
    result.reserve(vertices.size());
    std::vector<Weighted> carried; // of one vertex
    for (const std::size_t vertex : vertices) {
        carried.clear();
        double sum = 0;
        for (const JointSet& set : sets) {
            if (vertex >= set.joints.count || vertex >= set.weights.count) {
                source_.fail("{} has joints for {} vertices and weights for {}, but vertex {}",
                             name, set.joints.count, set.weights.count, vertex);
            }
            for (int k = 0; k < 4; ++k) {
                const double weight = read_component(set.weights, vertex, k);
                const double joint = read_component(set.joints, vertex, k);
                if (!(weight >= 0) || !std::isfinite(weight)) {
                    source_.fail("vertex {} of {} has a joint weight of {}; it must be at least 0",
                                 vertex, name, weight);
                }
                if (weight > 0 && !(joint < static_cast<double>(joints))) {
                    source_.fail("vertex {} of {} has joint {}, but its skin has {}", vertex, name,
                                 joint, joints);
                }
                if (weight > 0) {
                    carried.emplace_back(weight, static_cast<std::uint32_t>(joint));
                    sum += weight;
                }
            }
        }
        if (!(sum > 0) || !std::isfinite(sum)) {
            source_.fail("vertex {} of {} has joint weights that sum to {}", vertex, name, sum);
        }
        if (std::abs(sum - 1) > most_off) {
            add_note(scene,
                     fmt::format("joint weights of {} do not sum to 1; they are normalised", name));
        }
        if (carried.size() > 4) {
            add_note(scene, fmt::format("more than four joints carry a vertex of {}; the heaviest "
                                        "four count",
                                        name));
        }
        result.push_back(heaviest(carried, sum));
    }
    return result;
}

} // namespace argand
