#pragma once

#include "photon/photon_map.hpp"

namespace argand {

/// Iterations of a query in one dispatch: well below the 65,535 after which lavapipe ends loops
/// silently.
inline constexpr std::uint32_t gather_budget = 16384;

/// What a gather reads and writes, per slot of an eye path.
struct GatherTarget {
    Buffer slots, counts; ///< slots that ask, and the buffer that holds their number
    Buffer queries;       ///< QueryRecord per slot
    Buffer estimates; ///< EstimateRecord: what is scattered towards the eye, without the throughput
    Buffer partial; ///< GatherRecord: queries between two dispatches (gather_nearest does without)
    std::uint32_t part = map_whole; ///< map_*: the photons that are looked for
    bool final_gather = false; ///< queries limit the photons' scatterings (shared/query_record.h)
};

/// Radii of density estimation, in the scene's units; caustics are sharp, and have one of their
/// own, at most the other.
struct GatherRadii {
    double indirect = 0;
    double caustic = 0;
};

/// Estimates for every query the radiance that estimated lobes scatter towards the eye: density
/// estimation with the Epanechnikov kernel over the photons within the radii, which are the same
/// for all queries (as in each pass of Hachisuka et al. 2008). Queries that take more iterations
/// than one dispatch allows are counted in traversal.unfinished; if traversal.careful is set, gone
/// on with until they are done.
void gather_photons(Device& device, const DeviceScene& scene, const PhotonMap& map,
                    const GatherTarget& target, Traversal& traversal, const GatherRadii& radii,
                    const Count& asking, std::uint32_t budget = gather_budget);

/// As gather_photons, over the footprints that reach each query (Fabianowski and Dingliana 2009,
/// eq. 1): the map must have some. uniform_kernel: instead of Epanechnikov's.
void gather_footprints(Device& device, const DeviceScene& scene, const PhotonMap& map,
                       const GatherTarget& target, Traversal& traversal, bool uniform_kernel,
                       const Count& asking, std::uint32_t budget = gather_budget);

} // namespace argand
