#pragma once

#include "photon/estimator.hpp"
#include "shared/camera.h"

namespace argand {

/// Which queries of eye paths traced together share an estimate: those in one cell of a grid.
struct QuerySharing {
    double cell = 0; ///< largest edge of a cell, in the scene's units; 0: queries share nothing
    bool caustics_apart = false; ///< the caustic part of the map is queried separately, and shared
                                 ///< in cells no larger than a pixel
    bool sharp_caustics = false; ///< with caustics_apart: caustic queries share nothing
};

/// Device memory for the photon map queries of eye paths.
struct EyeQueries {
    Buffer points, bsdfs;        ///< QueryRecord and QueryBsdfRecord per slot
    Buffer kinds;                ///< uint per slot: query_kind_* of its query, or 0; with
                                 ///< query_then_continues
    Buffer all;                  ///< the numbers of all slots
    Buffer chosen, slots;        ///< flags of the waiting paths, and slots, of the queries that the
                                 ///< estimator answers; the others share their estimates
    Buffer estimates, suspended; ///< see PhotonQueries
    Buffer sources;              ///< uint per slot: the slot whose estimate it takes, or no_query
    Buffer cells, owners;        ///< hash table of cells, see query_cells.h
    CameraRecord view{};         ///< of the picture, for the size of its pixels
    bool final_gather = false;   ///< paths query the map one scattering later, except for caustics
    QuerySharing sharing;
};

/// Allocates for paths in `slots` slots. Plans without a photon map need only what kernels bind.
EyeQueries make_eye_queries(Device& device, const Plan& plan, std::uint64_t slots,
                            const CameraRecord& view);

/// The paths that wait for the answers of their queries.
struct WaitingPaths {
    const Buffer& slots;
    const Buffer& counts;  ///< [0]: their number; [counts_of_queries]: room for that of the queries
    std::uint64_t most;    ///< of them
    const Buffer& layers;  ///< LayersRecord per slot, to which estimates are added
    const Buffer& records; ///< PathRecord per slot
    std::uint32_t bounces; ///< most scatterings between the light and the first estimated vertex
    bool first;            ///< none has waited before
    const Traversal& traversal;
};
inline constexpr std::uint32_t counts_of_queries = 2;

/// Estimates the radiance at the vertices that have queries, once for all queries in a cell, and
/// adds it to the paths' layers. Paths that seek emission go on where the lookup does not take the
/// estimate.
void answer_queries(Device& device, const Plan& plan, const EyeQueries& queries,
                    const WaitingPaths& paths, const PhotonLookup& lookup);

} // namespace argand
