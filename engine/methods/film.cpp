#include "methods/film.hpp"

#include "methods/persist_buffer.hpp"

#include <algorithm>

namespace argand {

namespace {

/// A number whose words a record holds.
std::uint64_t joined(std::uint32_t low, std::uint32_t high) {
    return (std::uint64_t(high) << 32) | low;
}

} // namespace

Film make_film(Device& device, int width, int height) {
    Film film{.width = width, .height = height};
    film.pixels_per_part = device.info().limits.storage_range / sizeof(FilmRecord);
    for (std::uint64_t first = 0; first < film.pixels(); first += film.pixels_per_part) {
        const std::uint64_t pixels = std::min(film.pixels_per_part, film.pixels() - first);
        film.parts.push_back(device.allocate("film", pixels * sizeof(FilmRecord)));
        device.fill(film.parts.back(), 0);
    }
    return film;
}

void persist_film(Archive& archive, Device& device, const Film& film) {
    for (const Buffer& part : film.parts) {
        persist_buffer(archive, device, part, part.size());
    }
}

std::vector<FilmRecord> download_film(Device& device, const Film& film) {
    const auto pixels = static_cast<std::size_t>(film.pixels());
    std::vector<FilmRecord> records;
    records.reserve(pixels);
    for (const Buffer& part : film.parts) {
        const std::size_t count =
            std::min<std::size_t>(film.pixels_per_part, pixels - records.size());
        const std::vector<FilmRecord> of_part = download<FilmRecord>(device, part, count);
        records.insert(records.end(), of_part.begin(), of_part.end());
    }
    return records;
}

std::uint64_t finite_samples(const FilmRecord& record) {
    return joined(record.samples, record.samples_high) -
           joined(record.non_finite, record.non_finite_high);
}

std::vector<Layer> resolve_film(Device& device, const Film& film, RenderStatistics& statistics) {
    const auto pixels = static_cast<std::size_t>(film.pixels());
    const std::vector<FilmRecord> records = download_film(device, film);
    std::vector<Layer> layers{{"", {}}, {"direct", {}}, {"indirect", {}}, {"caustic", {}}};
    for (Layer& layer : layers) {
        layer.image.width = film.width;
        layer.image.height = film.height;
        layer.image.pixels.resize(pixels);
    }
    statistics.samples = pixels > 0 ? joined(records[0].samples, records[0].samples_high) : 0;
    statistics.non_finite = 0;
    for (std::size_t i = 0; i < pixels; ++i) {
        const FilmRecord& r = records[i];
        const std::uint64_t finite = finite_samples(r);
        const float scale = finite > 0 ? 1.0f / static_cast<float>(finite) : 0.0f;
        const glm::vec3 direct = glm::vec3(r.direct_r, r.direct_g, r.direct_b) * scale;
        const glm::vec3 indirect = glm::vec3(r.indirect_r, r.indirect_g, r.indirect_b) * scale;
        const glm::vec3 caustic = glm::vec3(r.caustic_r, r.caustic_g, r.caustic_b) * scale;
        layers[0].image.pixels[i] = direct + indirect + caustic;
        layers[1].image.pixels[i] = direct;
        layers[2].image.pixels[i] = indirect;
        layers[3].image.pixels[i] = caustic;
        statistics.non_finite += joined(r.non_finite, r.non_finite_high);
    }
    return layers;
}

} // namespace argand
