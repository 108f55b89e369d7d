#pragma once

#include "scene/gltf_source.hpp"
#include "scene/key_frames.hpp"
#include <optional>
#include <string>

namespace argand {

constexpr std::size_t most_key_numbers = std::size_t(1) << 23; // of all keys of a file

/// What a channel of an animation moves.
struct KeyTarget {
    std::optional<KeyFrames>* keys = nullptr; ///< null: nothing that is supported
    int components = 0;                       ///< of an element of the output accessor
    std::size_t elements = 1;                 ///< of a value
    bool rotation = false;                    ///< the values are rotations
    std::string moves;                        ///< "rotation of node 2 "wheel""
};

/// Reads a sampler's keys for this target. Takes the numbers of the values from those that the
/// file may still have. `what` names the sampler in messages. Throws Error if times do not rise, or
/// the values do not fit the target or are not finite.
KeyFrames read_keys(const GltfSource& source, const tinygltf::AnimationSampler& sampler,
                    const KeyTarget& target, const std::string& what, std::size_t& numbers_left);

} // namespace argand
