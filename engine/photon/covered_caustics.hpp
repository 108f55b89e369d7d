#pragma once

#include "photon/estimator.hpp"

namespace argand {

/// The indices, among the map's records, of caustic photons whose footprints hold area samples;
/// photon_footprints lists them.
Buffer wide_caustics(Device& device, const PhotonWorkspace& workspace);

/// Divides the flux of these photons by the share of their footprints that lies on surfaces, if the
/// map has an area tree. uniform_kernel: of the footprints, instead of Epanechnikov's. Records
/// only.
void correct_caustic_footprints(Device& device, const PhotonWorkspace& workspace,
                                const PhotonMap& map, bool uniform_kernel);

/// Discs of density estimation for caustics alone.
struct CausticDiscs {
    double radius = 0;           ///< of all discs; 0: each has its own
    Buffer squared_radii;        ///< float per slot, for discs with radii of their own
    bool uniform_kernel = false; ///< instead of Epanechnikov's
};

/// Divides the estimates of caustics by the share of their discs that lies on surfaces, if the map
/// has an area tree. Records only.
void correct_caustic_discs(Device& device, const PhotonMap& map, const PhotonQueries& queries,
                           const CausticDiscs& discs);

} // namespace argand
