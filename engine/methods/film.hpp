#pragma once

#include "base/archive.hpp"
#include "device/device.hpp"
#include "methods/render_result.hpp"
#include "shared/path_records.h"

#include <cstdint>
#include <vector>

namespace argand {

/// Sums of every pixel's samples by layer, on the device.
struct Film {
    int width = 0, height = 0;
    std::uint64_t pixels_per_part = 0; ///< as many as a kernel can address
    std::vector<Buffer> parts;         ///< FilmRecord per pixel

    std::uint64_t pixels() const {
        return static_cast<std::uint64_t>(width) * static_cast<std::uint64_t>(height);
    }
};

/// A film without samples. Records only.
Film make_film(Device& device, int width, int height);

/// Saves or loads the film's sums. Waits for the device.
void persist_film(Archive& archive, Device& device, const Film& film);

/// The sums of all pixels. Waits for the device.
std::vector<FilmRecord> download_film(Device& device, const Film& film);

/// Samples of a pixel that its sums hold.
std::uint64_t finite_samples(const FilmRecord& record);

/// The means over each pixel's samples, as in RenderResult::layers. Sets the statistics' numbers of
/// samples. Waits for the device.
std::vector<Layer> resolve_film(Device& device, const Film& film, RenderStatistics& statistics);

} // namespace argand
