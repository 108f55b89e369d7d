#pragma once

#include "device/info.hpp"
#include "methods/method_info.hpp"
#include "scene/scene.hpp"

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace argand {

/// What an image's bits depend on, by name: scene, settings, device and build. Only a render of the
/// same can be resumed.
using CheckpointKey = std::vector<std::pair<std::string, std::string>>;

CheckpointKey checkpoint_key(const Scene& scene, const RenderSettings& settings,
                             const MethodInfo& method, const DeviceInfo& device);

/// The second to last checkpoint, beside the last (after symbolic links).
std::filesystem::path older_checkpoint(const std::filesystem::path& path);

/// Throws Error if save_checkpoint() would fail, as far as that can be known beforehand, or would
/// replace anything but checkpoints of the render that goes on from `resumed` (empty: from its
/// start).
void check_checkpoint_writable(const std::filesystem::path& path,
                               const std::filesystem::path& resumed);

/// Throws Error if save_checkpoint() would replace a whole checkpoint with another key.
void check_checkpoints_replaced(const std::filesystem::path& path, const CheckpointKey& key);

/// Writes the state of a session (Session::save()). The checkpoint that was there before, if it is
/// whole, becomes the older one. Whatever happens, one whole checkpoint stays. Throws Error if it
/// cannot write.
void save_checkpoint(const std::filesystem::path& path, CheckpointKey key,
                     std::vector<std::uint8_t> state);

struct LoadedCheckpoint {
    std::vector<std::uint8_t> state; ///< for Session::resume()
    std::optional<std::string> note; ///< for the user: why it is the older one
};

/// Reads a checkpoint, or the older one if this one is missing or damaged. Throws Error if neither
/// can be read, or if the checkpoint has another key: it names what differs.
LoadedCheckpoint load_checkpoint(const std::filesystem::path& path, const CheckpointKey& key);

} // namespace argand
