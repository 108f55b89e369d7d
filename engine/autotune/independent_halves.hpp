#pragma once

#include "image/image.hpp"

#include <array>
#include <cstdint>

namespace argand {

/// Splits the passes of a render into two independent halves, whose difference measures the noise
/// while the render runs. Two streams of random numbers take turns. Turns grow longer with the
/// number of passes, so that a long render is rarely interrupted to read its image.
class IndependentHalves {
public:
    /// Stream of random numbers for the next pass: 0 or 1.
    std::uint32_t stream() const { return turn_ % 2; }

    /// Number of passes in all at the end of the current turn.
    std::uint64_t next() const { return done_ + length_; }

    /// Number of passes in all at the end of the last turn.
    std::uint64_t passes() const { return done_; }

    /// Call at the end of each turn, with the mean of all passes so far.
    void add(const Image& mean_so_far);

    /// Whether both halves have passes.
    bool both_have_passes() const { return passes_[1] > 0; }

    /// relMSE of the mean of all passes that is due to noise. Requires passes in both halves.
    /// reference: the image from which relMSE takes its denominator.
    double noise(const Image& reference) const;

    /// Mean of each half.
    const std::array<Image, 2>& means() const { return means_; }

private:
    std::uint32_t turn_ = 0;
    std::uint64_t length_ = 1, done_ = 0;
    std::array<Image, 2> means_;
    std::array<double, 2> passes_{};
    Image mean_; ///< of all passes
};

} // namespace argand
