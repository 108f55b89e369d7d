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

/// The words that a stage changed in one of the buffers that it writes.
struct GoldenWrite {
    struct Run {
        std::uint32_t first, count;
    };
    std::uint32_t size = 0;           ///< words of the buffer
    std::vector<Run> runs;            ///< ascending, apart
    std::vector<std::uint32_t> words; ///< of all runs, one after another
};

/// The changed words between two states of a buffer.
GoldenWrite changes(std::span<const std::uint32_t> before, std::span<const std::uint32_t> after);
/// Makes them. Throws Error if the buffer is of another size or they exceed it.
void apply_changes(const GoldenWrite& write, std::span<std::uint32_t> words);

struct GoldenStep {
    std::string stage;
    std::vector<GoldenWrite> writes; ///< one for each buffer that the stage writes
};

/// All that a device did while it rendered a picture with one method.
using GoldenCapture = std::vector<GoldenStep>;

/// What a file holds. Like a program, a capture is to be trusted: what it says is read by kernels,
/// which check no index.
struct Golden {
    std::string scene;                    ///< its file's name
    std::uint64_t fingerprint = 0;        ///< of its geometry, see scene/fingerprint.hpp
    std::string device, driver, revision; ///< where and from what it was recorded
    Features features;                    ///< of that device; they decide which stages there are
    int width = 0, height = 0;
    std::uint32_t samples = 0, seed = 0;
    std::uint64_t photons = 0;
    std::map<std::string, GoldenCapture> captures; ///< by method
};

void write_golden(const std::filesystem::path& file, const Golden& golden);
/// Throws Error if the file is missing, cut short or not a capture.
Golden read_golden(const std::filesystem::path& file);

} // namespace argand
