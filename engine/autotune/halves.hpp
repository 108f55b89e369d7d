#pragma once

#include "image/image.hpp"

#include <array>
#include <cstdint>

namespace argand {

/// The passes of a picture, about half of them of one stream and half of another, whose difference
/// tells its noise while it is being rendered. The streams take turns of more and more passes, so
/// that a long render is rarely looked at.
class Halves {
public:
    /// Of the next pass.
    std::uint32_t stream() const { return turn_ % 2; }

    /// Passes in all at the end of this turn.
    std::uint64_t next() const { return done_ + length_; }

    /// Passes in all at the end of the last turn.
    std::uint64_t passes() const { return done_; }

    /// Told the mean of all passes at the end of each turn.
    void add(const Image& mean_so_far);

    /// Whether both have passes.
    bool are_two() const { return passes_[1] > 0; }

    /// relMSE of the mean that is due to noise, where there are two. reference: what relMSE divides
    /// by.
    double noise(const Image& reference) const;

    const std::array<Image, 2>& means() const { return means_; }

private:
    std::uint32_t turn_ = 0;
    std::uint64_t length_ = 1, done_ = 0;
    std::array<Image, 2> means_;
    std::array<double, 2> passes_{};
    Image mean_; ///< of all
};

} // namespace argand
