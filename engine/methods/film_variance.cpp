#include "methods/film_variance.hpp"

namespace argand {

/// Adds what the film has received since the pixel was last visited.
void FilmVariance::add_sums(const FilmRecord& r, Pixel& pixel) {
    const glm::dvec3 sum = glm::dvec3(r.direct_r, r.direct_g, r.direct_b) +
                           glm::dvec3(r.indirect_r, r.indirect_g, r.indirect_b) +
                           glm::dvec3(r.caustic_r, r.caustic_g, r.caustic_b) -
                           glm::dvec3(r.lost_direct_r, r.lost_direct_g, r.lost_direct_b) -
                           glm::dvec3(r.lost_indirect_r, r.lost_indirect_g, r.lost_indirect_b) -
                           glm::dvec3(r.lost_caustic_r, r.lost_caustic_g, r.lost_caustic_b);
    const auto samples = static_cast<double>(finite_samples(r));
    const double of_pass = samples - pixel.samples;
    if (of_pass > 0) {
        const glm::dvec3 difference = (sum - pixel.sum) / of_pass - pixel.mean;
        pixel.mean += difference * (of_pass / samples);
        pixel.squares += difference * difference * (of_pass * pixel.samples / samples);
        ++pixel.passes;
    }
    pixel.sum = sum;
    pixel.samples = samples;
}

void FilmVariance::add_pass(Device& device, const Film& film) {
    pixels_.resize(static_cast<std::size_t>(film.pixels()));
    visit_film(device, film, [&](std::size_t first, std::span<const FilmRecord> records) {
        for (std::size_t i = 0; i < records.size(); ++i) {
            add_sums(records[i], pixels_[first + i]);
        }
    });
}

Image FilmVariance::of_mean(const Film& film) const {
    Image image{film.width, film.height, {}};
    image.pixels.resize(static_cast<std::size_t>(film.pixels()));
    for (std::size_t i = 0; i < pixels_.size(); ++i) {
        const Pixel& pixel = pixels_[i];
        if (pixel.passes > 1) {
            image.pixels[i] = glm::vec3(pixel.squares / ((pixel.passes - 1.0) * pixel.samples));
        }
    }
    return image;
}

} // namespace argand
