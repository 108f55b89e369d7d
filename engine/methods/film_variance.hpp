#pragma once

#include "methods/film.hpp"

#include <vector>

namespace argand {

/// The variance of an image's pixels, from how its passes differ (batch means). A pass of a photon
/// map shares its photons, so that samples of one pass are not independent, but passes are. The
/// bias of a method is no part of it.
class FilmVariance {
public:
    /// Learns a pass that has just been added to the film. Waits for the device.
    void add_pass(Device& device, const Film& film);

    /// Variance of each pixel's mean over all samples, by channel: with n_i samples of mean m_i in
    /// each of k passes, sum n_i (m_i - m)² / ((k - 1) sum n_i). Zero after fewer than two passes.
    Image of_mean(const Film& film) const;

private:
    struct Pixel {
        glm::dvec3 sum{0};              ///< of the samples so far
        double samples = 0;             ///< that were finite
        glm::dvec3 mean{0}, squares{0}; ///< of the passes, weighted by samples (West 1979)
        std::uint32_t passes = 0;
    };
    static void add_sums(const FilmRecord& r, Pixel& pixel);

    std::vector<Pixel> pixels_;
};

} // namespace argand
