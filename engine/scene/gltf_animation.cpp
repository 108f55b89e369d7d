#include "scene/gltf_animation.hpp"

#include "scene/gltf_value.hpp"
#include <algorithm>
#include <set>

namespace argand {
namespace {

using nlohmann::json;

constexpr std::size_t most_pointers_noted = 20;

/// Reads the channels of a file's animations.
struct ChannelReader {
    const GltfSource& source;
    Scene& scene;
    FileKeys keys;
    std::size_t numbers_left = most_key_numbers;
    std::set<std::string> unsupported; ///< pointers

    /// `what` names the animation in messages.
    void read(const KeyTarget& target, int sampler, const tinygltf::Animation& from,
              const std::string& what, Animation& animation) {
        if (sampler < 0 || std::size_t(sampler) >= from.samplers.size()) {
            source.fail("{} refers to sampler {}, which does not exist", what, sampler);
        }
        if (*target.keys) {
            add_note(scene, "several animations move one property; the first one counts");
            return;
        }
        *target.keys = read_keys(source, from.samplers[std::size_t(sampler)], target,
                                 fmt::format("sampler {} of {}", sampler, what), numbers_left);
        animation.seconds = std::max(animation.seconds, (*target.keys)->times.back());
        animation.moves.push_back(target.moves);
    }

    void read_channel(const tinygltf::AnimationChannel& channel, const tinygltf::Animation& from,
                      const std::string& what, Animation& animation) {
        // A channel without a node is to be ignored: glTF 2.0, section 5.4.1.
        if (channel.target_node >= 0 && channel.target_path != "pointer") {
            read(node_target(source, std::size_t(channel.target_node), channel.target_path, keys,
                             what),
                 channel.sampler, from, what, animation);
        }
    }

    /// tinygltf leaves out channels that have no node.
    void read_pointer(const json& channel, const tinygltf::Animation& from, const std::string& what,
                      Animation& animation) {
        const json* target = find_member(&channel, "target");
        const json* path = find_member(target, "path");
        if (!path || *path != "pointer") {
            return;
        }
        const json* extension = find_extension(target, "KHR_animation_pointer");
        if (!extension) {
            add_note(scene, "channels that move a \"pointer\" which they do not state are ignored");
            return;
        }
        const json* pointer = find_member(extension, "pointer");
        if (!pointer || !pointer->is_string()) {
            source.fail("{} moves a \"pointer\" but has no KHR_animation_pointer that is text",
                        what);
        }
        const auto property = pointer->get<std::string>();
        const KeyTarget found = pointer_target(source, property, keys, what);
        if (!found.keys) {
            unsupported.insert(one_line(property, 120));
            return;
        }
        const json* sampler = find_member(&channel, "sampler");
        if (!sampler || !sampler->is_number_unsigned()) {
            source.fail("{} moves the {} by no sampler", what, found.moves);
        }
        read(found, sampler->get<int>(), from, what, animation);
    }

    void note_unsupported() const {
        std::size_t left = unsupported.size();
        for (const std::string& pointer : unsupported) {
            if (unsupported.size() - left == most_pointers_noted) {
                add_note(scene, fmt::format("animations of {} more are not supported yet", left));
                break;
            }
            add_note(scene, fmt::format("animations of {} are not supported yet", pointer));
            --left;
        }
    }
};

} // namespace

FileKeys read_animations(const GltfSource& source, Scene& scene) {
    ChannelReader reader{source, scene, no_keys(source)};
    for (std::size_t i = 0; i < source.model.animations.size(); ++i) {
        const tinygltf::Animation& from = source.model.animations[i];
        const std::string what = label("animation", static_cast<int>(i), from.name);
        Animation animation;
        animation.name = one_line(from.name);
        for (const tinygltf::AnimationChannel& channel : from.channels) {
            reader.read_channel(channel, from, what, animation);
        }
        const json* channels = find_member(find_element(source, "animations", i), "channels");
        for (std::size_t k = 0; channels && channels->is_array() && k < channels->size(); ++k) {
            reader.read_pointer((*channels)[k], from, what, animation);
        }
        scene.animations.push_back(std::move(animation));
    }
    reader.note_unsupported();
    return std::move(reader.keys);
}

} // namespace argand
