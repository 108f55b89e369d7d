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

void visit_film(Device& device, const Film& film, const FilmVisitor& visit) {
    constexpr std::uint64_t longest_piece = std::uint64_t{1} << 14; // 1.5 MiB
    std::vector<FilmRecord> piece;
    std::uint64_t first = 0;
    for (const Buffer& part : film.parts) {
        const std::uint64_t end = first + part.size() / sizeof(FilmRecord);
        for (std::uint64_t in_part = 0; first < end; first += piece.size()) {
            piece.resize(static_cast<std::size_t>(std::min(longest_piece, end - first)));
            const std::span<std::byte> bytes = std::as_writable_bytes(std::span(piece));
            device.download(part, in_part, bytes);
            in_part += bytes.size();
            visit(static_cast<std::size_t>(first), piece);
        }
    }
}

std::uint64_t finite_samples(const FilmRecord& record) {
    return joined(record.samples, record.samples_high) -
           joined(record.non_finite, record.non_finite_high);
}

std::vector<Layer> resolve_film(Device& device, const Film& film, RenderStatistics& statistics) {
    const auto pixels = static_cast<std::size_t>(film.pixels());
    std::vector<Layer> layers{{"", {}}, {"direct", {}}, {"indirect", {}}, {"caustic", {}}};
    for (Layer& layer : layers) {
        layer.image.width = film.width;
        layer.image.height = film.height;
        layer.image.pixels.resize(pixels);
    }
    statistics.samples = statistics.non_finite = 0;
    visit_film(device, film, [&](std::size_t first, std::span<const FilmRecord> records) {
        if (first == 0) {
            statistics.samples = joined(records[0].samples, records[0].samples_high);
        }
        for (std::size_t i = 0; i < records.size(); ++i) {
            const FilmRecord& r = records[i];
            const std::uint64_t finite = finite_samples(r);
            const float scale = finite > 0 ? 1.0f / static_cast<float>(finite) : 0.0f;
            const glm::vec3 direct = glm::vec3(r.direct_r, r.direct_g, r.direct_b) * scale;
            const glm::vec3 indirect = glm::vec3(r.indirect_r, r.indirect_g, r.indirect_b) * scale;
            const glm::vec3 caustic = glm::vec3(r.caustic_r, r.caustic_g, r.caustic_b) * scale;
            layers[0].image.pixels[first + i] = direct + indirect + caustic;
            layers[1].image.pixels[first + i] = direct;
            layers[2].image.pixels[first + i] = indirect;
            layers[3].image.pixels[first + i] = caustic;
            statistics.non_finite += joined(r.non_finite, r.non_finite_high);
        }
    });
    return layers;
}

} // namespace argand
