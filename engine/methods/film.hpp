#pragma once

#include "base/archive.hpp"
#include "device/device.hpp"
#include "methods/render_result.hpp"
#include "shared/path_records.h"

#include <cstdint>
#include <functional>
#include <span>
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

/// What visits the sums of successive pixels, of which the first is pixel `first`.
using FilmVisitor = std::function<void(std::size_t first, std::span<const FilmRecord>)>;

/// Visits the sums of all pixels in their order. They come in pieces that fit into a cache, so that
/// a large film takes no memory of its size. Waits for the device.
void visit_film(Device& device, const Film& film, const FilmVisitor& visit);

/// Samples of a pixel that its sums hold.
std::uint64_t finite_samples(const FilmRecord& record);

/// The means over each pixel's samples, as in RenderResult::layers. Sets the statistics' numbers of
/// samples. Waits for the device.
std::vector<Layer> resolve_film(Device& device, const Film& film, RenderStatistics& statistics);

} // namespace argand
