#pragma once

#include <cstdint>

namespace argand {

/// What a preview of a moving scene is rendered with.
struct PreviewSize {
    double scale = 1; ///< of the picture's sides
    std::uint64_t photons = 0;
    bool operator==(const PreviewSize&) const = default;
};

/// Between which the sizes of previews are chosen.
struct PreviewLimits {
    std::uint64_t pixels = 1; ///< of the picture at full size
    double least_scale = 1.0 / 8;
    std::uint64_t least_photons = 1000, most_photons = 200'000; ///< both 0: a method without any
};

/// Seconds that a preview took.
struct PreviewTime {
    double photons = 0; ///< emitting, tracing and storing them
    double pixels = 0;  ///< eye paths, and estimates at their ends
    double rest = 0;    ///< everything else
};

/// Chooses the size of each preview so that it takes a given time. It takes the time as linear in
/// pixels and photons, as the previews so far were, and stays with a size that still fits, so that
/// the picture does not swing. Of the time that is left for both, photons get two fifths: the best
/// share where noise of eye paths, which falls with one over their number, and error of density
/// estimates, which falls with the number of photons to the power of -2/3, are equal.
class FrameTime {
public:
    /// seconds: for each preview, positive.
    FrameTime(double seconds, const PreviewLimits& limits);

    /// The size of the next preview.
    PreviewSize next() const { return size_; }

    /// Learns from a preview of the size next().
    void add(const PreviewTime& time);

    double seconds() const { return seconds_; }

private:
    double pixels(double scale) const;
    double expected(const PreviewSize& size) const;
    PreviewSize best() const;

    double seconds_;
    PreviewLimits limits_;
    PreviewSize size_;
    // Seconds of a photon, of a pixel, and of what depends on neither; 0: not known yet.
    double photon_ = 0, pixel_ = 0, rest_ = 0;
};

} // namespace argand
