#pragma once

#include "base/archive.hpp"
#include "methods/render_settings.hpp"
#include "photon/photon_map.hpp"

#include <cstdint>
#include <map>

namespace argand {

/// Numbers the photons of an image's passes. Those of one seed follow one another, because they are
/// points of one Sobol' sequence, whatever the sizes of the passes. No point is taken twice.
class PhotonNumbers {
public:
    /// `count` photons of the next pass with this seed, at most numbers_of_seed of them. Where
    /// their numbers would exceed 32 bits, they begin anew with another seed: the same points,
    /// scrambled otherwise. Leaves PhotonPass::bounces at 0.
    PhotonPass next(std::uint32_t seed, std::uint64_t count);

    /// Saves or loads how many numbers each seed has given.
    void persist(Archive& archive);

private:
    /// By the seed of a pass: how often another seed has taken its place, times 2^32, plus the next
    /// number.
    std::map<std::uint32_t, std::uint64_t> next_;
};

/// Which numbers photons take: numbers_* of shared/sampling.h.
std::uint32_t kind_of_photon_numbers(const RenderSettings& settings);

} // namespace argand
