#include "tradeoff/halves.hpp"

#include "image/metrics.hpp"

#include <algorithm>

namespace argand {

namespace {

constexpr std::uint64_t turns = 16;     // that are kept apart, about

} // namespace

void Halves::add(const Image& mean_so_far) {
    const auto before = static_cast<double>(done_);
    const auto more = static_cast<double>(length_);
    Image& mean = means_[stream()];
    double& passes = passes_[stream()];
    const Image part = done_ > 0 ? part_of(mean_, before, mean_so_far, before + more) : mean_so_far;
    if (passes > 0) {
        // part_of's inverse.
        mean = part_of(mean, -passes, part, more);
    } else {
        mean = part;
    }
    passes += more;
    done_ += length_;
    mean_ = mean_so_far;
    ++turn_;
    if (stream() == 0) {
        length_ = std::max<std::uint64_t>(done_ / turns, 1);
    }
}

double Halves::noise(const Image& reference) const { return rel_variance(means_, reference, reference) / 2; }

Image part_of(const Image& before, double passes_before, const Image& after, double passes_after) {
    Image part = after;
    const double passes = passes_after - passes_before;
    for (std::size_t i = 0; i < part.pixels.size(); ++i) {
        part.pixels[i] = (passes_after / passes) * glm::dvec3(after.pixels[i]) -
                         (passes_before / passes) * glm::dvec3(before.pixels[i]);
    }
    return part;
}

} // namespace argand
