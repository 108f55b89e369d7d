#pragma once

#include "device/info.hpp"
#include "scene/scene.hpp"

#include <cstdint>
#include <filesystem>
#include <map>
#include <span>
#include <string>
#include <vector>

namespace argand {

/// The words that a stage changed in one of its output buffers.
struct GoldenWrite {
    struct Run {
        std::uint32_t first, count;
    };
    std::uint32_t size = 0;           ///< words of the buffer
    std::vector<Run> runs;            ///< ascending, with gaps between them
    std::vector<std::uint32_t> words; ///< contents of all runs
};

/// The words that differ between two states of a buffer.
GoldenWrite changes(std::span<const std::uint32_t> before, std::span<const std::uint32_t> after);
/// Applies the changes. Throws Error if the buffer has another size or the changes exceed it.
void apply_changes(const GoldenWrite& write, std::span<std::uint32_t> words);

struct GoldenStep {
    std::string stage;
    std::vector<GoldenWrite> writes; ///< one for each buffer that the stage writes
};

/// Results of every stage while a device rendered an image with one method.
using GoldenCapture = std::vector<GoldenStep>;

/// Contents of a golden file. Load only trusted files: kernels read the captured data without
/// checking indices.
struct Golden {
    std::string scene;                    ///< name of its file
    std::uint64_t fingerprint = 0;        ///< of its geometry, see scene/fingerprint.hpp
    std::string device, driver, revision; ///< device and revision of the recording
    Features features;                    ///< of that device; they determine the stages
    int width = 0, height = 0;
    std::uint32_t samples = 0, seed = 0;
    std::uint64_t photons = 0;
    std::map<std::string, GoldenCapture> captures; ///< by method
};

void write_golden(const std::filesystem::path& file, const Golden& golden);
/// Throws Error if the file is missing, truncated or not a capture.
Golden read_golden(const std::filesystem::path& file);

} // namespace argand
