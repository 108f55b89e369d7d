#pragma once

#include "photon/photon_map.hpp"
#include "shared/path_records.h"
#include "shared/query_record.h"

namespace argand {

/// Points at which a photon map is queried, and the estimates at these points. Records lie in slots
/// that the queries share with the paths they belong to.
struct PhotonQueries {
    Buffer points;     ///< in: QueryRecord per slot
    Buffer bsdfs;      ///< in: QueryBsdfRecord per slot; one element if the plan has no glossy
                       ///< estimates
    Buffer slots;      ///< in: uint per query, its slot
    Count count = 0;   ///< of `slots`; the number is on the device
    Buffer estimates;  ///< out: EstimateRecord per slot, without the path's throughput
    Buffer suspended;  ///< GatherRecord per slot: a query's state between two dispatches. The k
                       ///< nearest photons have states of their own, and do without it.
    Buffer unfinished; ///< uint that counts queries which ran out of iterations; the caller clears
                       ///< it. Estimates of these queries are wrong.
    bool until_complete = false;     ///< resumes queries until all are complete, and waits for the
                                     ///< device; `unfinished` is not used then
    std::uint32_t part = map_whole;  ///< map_*: which photons count
    bool limits_scatterings = false; ///< of the photons that count, for each query
};

/// Estimates the radiance that the estimated lobes scatter towards the eye, at all query points in
/// one call.
class PhotonEstimator {
public:
    PhotonEstimator() = default;
    PhotonEstimator(const PhotonEstimator&) = delete;
    PhotonEstimator& operator=(const PhotonEstimator&) = delete;
    virtual ~PhotonEstimator() = default;

    /// Records only, unless `queries.until_complete`.
    virtual void estimate(const PhotonMap& map, const PhotonQueries& queries) = 0;
};

/// Which estimates eye paths do not take, but go on instead (estimate_add).
struct Untaken {
    std::uint32_t often = untaken_never; ///< untaken_* of shared/path_records.h
    /// Of an estimate that is taken; see unevenness(). With a limit of 0.03 the error of living
    /// rooms is hardly less than with 0.06, and with 0.015 it is more.
    float most_uneven = strongly_uneven;
    double least_coverage = 0; ///< of an estimate that is taken; 0 if all are

    static constexpr float strongly_uneven = 0.1875f; ///< nowhere to be taken: at a thin wall, the
                                                      ///< light of another room
    static constexpr float mildly_uneven = 0.06f;
};

/// The photon map that eye paths query, and how.
struct PhotonLookup {
    const PhotonMap& map;
    PhotonEstimator& estimator;
    /// Answers the queries of paths behind their first estimated vertices; none: `estimator` does.
    PhotonEstimator* gathers = nullptr;
    Untaken untaken;

    PhotonEstimator& gathering_estimator() const {
        return gathers != nullptr ? *gathers : estimator;
    }
};

} // namespace argand
