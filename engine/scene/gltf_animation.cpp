#include "scene/gltf_animation.hpp"

#include "scene/gltf_accessor.hpp"
#include "scene/gltf_morph.hpp"
#include "scene/gltf_value.hpp"
#include <algorithm>
#include <cmath>

namespace argand {
namespace {

using nlohmann::json;

constexpr std::size_t most_numbers = std::size_t(1) << 23; // of all keys of a file

Interpolation interpolation_of(const GltfSource& source, const std::string& name,
                               const std::string& what) {
    if (name == "LINEAR" || name.empty()) {
        return Interpolation::linear;
    }
    if (name == "STEP") {
        return Interpolation::step;
    }
    if (name == "CUBICSPLINE") {
        return Interpolation::cubic_spline;
    }
    source.fail("{} has the interpolation \"{}\", which glTF does not know", what,
                one_line(name, 40));
}

std::vector<double> read_times(const GltfSource& source, int accessor, const std::string& what) {
    const GltfAccessor input = open_accessor(source, accessor, "the times of " + what);
    if (input.components != 1 || input.component_type != TINYGLTF_COMPONENT_TYPE_FLOAT) {
        source.fail("the times of {} are not floating-point numbers", what);
    }
    if (input.count == 0) {
        source.fail("{} has no keys", what);
    }
    std::vector<double> times(input.count);
    for (std::size_t i = 0; i < times.size(); ++i) {
        times[i] = read_component(input, i, 0);
        if (!std::isfinite(times[i]) || (i > 0 && !(times[i] > times[i - 1]))) {
            source.fail("the times of {} do not rise: key {} is at {} s", what, i, times[i]);
        }
    }
    return times;
}

/// What a channel moves.
struct Target {
    std::optional<KeyFrames>* keys = nullptr; ///< null: nothing
    int components = 0;                       ///< of an element of the output accessor
    std::size_t elements = 1;                 ///< of a value
};

/// Takes the numbers of the values from those that the file may still have.
KeyFrames read_keys(const GltfSource& source, const tinygltf::AnimationSampler& sampler,
                    const Target& target, const std::string& what, std::size_t& numbers_left) {
    KeyFrames keys;
    keys.width = std::size_t(target.components) * target.elements;
    keys.interpolation = interpolation_of(source, sampler.interpolation, what);
    keys.times = read_times(source, sampler.input, what);
    const GltfAccessor output = open_accessor(source, sampler.output, "the values of " + what);
    const std::size_t expected = keys.times.size() * target.elements *
                                 (keys.interpolation == Interpolation::cubic_spline ? 3 : 1);
    if (output.components != target.components || output.count != expected) {
        source.fail("{} has {} values of {} numbers, but its {} keys need {} of {}", what,
                    output.count, output.components, keys.times.size(), expected,
                    target.components);
    }
    const std::size_t numbers = expected * std::size_t(target.components);
    if (numbers > numbers_left) {
        source.fail("the keys of its animations have more than {} numbers", most_numbers);
    }
    numbers_left -= numbers;
    if (output.component_type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT ||
        (output.component_type != TINYGLTF_COMPONENT_TYPE_FLOAT && !output.normalized)) {
        source.fail("the values of {} are neither floating-point nor normalised numbers", what);
    }
    keys.values.reserve(numbers);
    for (std::size_t i = 0; i < expected; ++i) {
        for (int k = 0; k < target.components; ++k) {
            keys.values.push_back(read_component(output, i, k));
            if (!std::isfinite(keys.values.back())) {
                source.fail("value {} of {} is not finite", i, what);
            }
        }
    }
    return keys;
}

/// Throws Error unless the value of every key is a rotation.
void check_rotations(const GltfSource& source, const KeyFrames& keys, const std::string& what) {
    for (const double time : keys.times) {
        const std::vector<double> r = value_at(keys, time);
        if (!(r[0] * r[0] + r[1] * r[1] + r[2] * r[2] + r[3] * r[3] > 0)) {
            source.fail("the rotation of {} at {} s is not a unit quaternion", what, time);
        }
    }
}

/// The member of `keys` to which a channel's path refers. targets: morph targets of the node's
/// mesh.
Target property_of(NodeKeys& keys, const std::string& path, std::size_t targets) {
    if (path == "translation") {
        return {&keys.translation, 3};
    }
    if (path == "rotation") {
        return {&keys.rotation, 4};
    }
    if (path == "weights") {
        return {&keys.weights, 1, targets};
    }
    return path == "scale" ? Target{&keys.scale, 3} : Target{};
}

/// Finds what a channel moves: nothing if it has no node.
Target target_of(const GltfSource& source, const tinygltf::AnimationChannel& channel,
                 std::vector<NodeKeys>& nodes, const std::string& what) {
    if (channel.target_node < 0) {
        return {}; // to be ignored: glTF 2.0, section 5.4.1
    }
    const auto index = std::size_t(channel.target_node);
    if (index >= nodes.size()) {
        source.fail("{} moves node {}, which does not exist", what, index);
    }
    const std::size_t targets = morph_target_count(source, channel.target_node);
    const Target target = property_of(nodes[index], channel.target_path, targets);
    if (!target.keys) {
        source.fail("{} moves \"{}\", which glTF does not know", what,
                    one_line(channel.target_path, 40));
    }
    const bool moves_weights = target.keys == &nodes[index].weights;
    if (moves_weights && targets == 0) {
        source.fail("{} moves the morph targets of node {}, which has none", what, index);
    }
    if (!moves_weights && !source.model.nodes[index].matrix.empty()) {
        source.fail("{} moves node {}, whose transform is a matrix", what, index);
    }
    return target;
}

Animation read_animation(const GltfSource& source, const tinygltf::Animation& from,
                         const std::string& what, std::vector<NodeKeys>& nodes,
                         std::size_t& numbers_left, Scene& scene) {
    Animation animation;
    animation.name = one_line(from.name);
    for (const tinygltf::AnimationChannel& channel : from.channels) {
        if (channel.sampler < 0 || std::size_t(channel.sampler) >= from.samplers.size()) {
            source.fail("{} refers to sampler {}, which does not exist", what, channel.sampler);
        }
        const Target target = target_of(source, channel, nodes, what);
        if (!target.keys) {
            continue;
        }
        if (*target.keys) {
            add_note(scene, "several animations move one property of a node; the first one counts");
            continue;
        }
        const std::string sampler = fmt::format("sampler {} of {}", channel.sampler, what);
        KeyFrames keys = read_keys(source, from.samplers[std::size_t(channel.sampler)], target,
                                   sampler, numbers_left);
        if (channel.target_path == "rotation") {
            check_rotations(source, keys, sampler);
        }
        animation.seconds = std::max(animation.seconds, keys.times.back());
        animation.moves.push_back(
            fmt::format("{} of {}", channel.target_path,
                        label("node", channel.target_node,
                              source.model.nodes[std::size_t(channel.target_node)].name)));
        *target.keys = std::move(keys);
    }
    return animation;
}

/// Their targets have no node, and tinygltf leaves them out.
void note_pointers(const GltfSource& source, Scene& scene) {
    for (std::size_t i = 0; const json* animation = find_element(source, "animations", i); ++i) {
        const json* channels = find_member(animation, "channels");
        for (std::size_t k = 0; channels && channels->is_array() && k < channels->size(); ++k) {
            if (find_extension(find_member(&(*channels)[k], "target"), "KHR_animation_pointer")) {
                add_note(scene, "animations by KHR_animation_pointer are not supported yet");
            }
        }
    }
}

} // namespace

std::vector<NodeKeys> read_animations(const GltfSource& source, Scene& scene) {
    note_pointers(source, scene);
    std::vector<NodeKeys> nodes(source.model.nodes.size());
    std::size_t numbers_left = most_numbers;
    for (std::size_t i = 0; i < source.model.animations.size(); ++i) {
        const tinygltf::Animation& from = source.model.animations[i];
        const std::string what = label("animation", static_cast<int>(i), from.name);
        scene.animations.push_back(read_animation(source, from, what, nodes, numbers_left, scene));
    }
    return nodes;
}

} // namespace argand
