#include "autotune/independent_halves.hpp"

#include "image/mean.hpp"
#include "image/metrics.hpp"

#include <algorithm>

namespace argand {

namespace {

constexpr std::uint64_t turns = 16; // a turn is about this fraction of all passes

} // namespace

void IndependentHalves::add(const Image& mean_so_far) {
    const auto before = static_cast<double>(done_);
    const auto more = static_cast<double>(length_);
    Image& mean = means_[stream()];
    double& passes = passes_[stream()];
    const Image part =
        done_ > 0 ? weighted_mean(mean_so_far, before + more, mean_, -before) : mean_so_far;
    mean = passes > 0 ? weighted_mean(mean, passes, part, more) : part;
    passes += more;
    done_ += length_;
    mean_ = mean_so_far;
    ++turn_;
    if (stream() == 0) {
        length_ = std::max<std::uint64_t>(done_ / turns, 1);
    }
}

double IndependentHalves::noise(const Image& reference) const {
    // If one pass has variance v, the mean of n passes has variance v / n, and the means of two
    // halves of a + b = n passes have a squared difference of v (1/a + 1/b).
    const double all = passes_[0] + passes_[1];
    return 2 * rel_variance(means_, reference, reference) * passes_[0] * passes_[1] / (all * all);
}

} // namespace argand
