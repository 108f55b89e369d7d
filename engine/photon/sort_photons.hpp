#pragma once

#include "photon/photon_map.hpp"

#include <algorithm>
#include <cmath>

namespace argand {

/// Sorts the places of the workspace's records by code into workspace.order, and counts the records
/// (counter_stored, counter_others). boxes: memory for a box per record. Returns the box of all
/// photons (BoxRecord) in scratch memory: codes divide the cube around it.
Buffer sort_places(Device& device, PhotonWorkspace& workspace, const Buffer& boxes,
                   bool wide_codes);

/// Lists the places of the workspace's records as they lie in workspace.order, and counts them
/// (counter_stored).
void list_places(Device& device, PhotonWorkspace& workspace);

/// The photons of a pass in the order of a space-filling curve, those that are not caustic before
/// the caustic ones. They lie in the workspace's memory: they are valid until it traces photons or
/// builds a map.
struct SortedPhotons {
    Buffer photons;    ///< PhotonRecord
    Buffer codes;      ///< uint per photon
    Buffer bounds;     ///< BoxRecord: of the cube that the codes divide
    Buffer footprints; ///< uvec4 per photon, as in PhotonMap; empty: none
    std::uint32_t others = 0, caustics = 0;
};

/// Rank, among every stride-th photon, of the photon that has this rank among all; both from 1.
inline std::uint32_t rank_among_every(double stride, double rank) {
    return static_cast<std::uint32_t>(
        std::max(std::round((rank + 0.5 * (stride - 1)) / stride), 1.0));
}

/// Sorts the photons that a pass has stored. Waits for the device.
SortedPhotons sort_photons(Device& device, PhotonWorkspace& workspace, const StoredPhotons& stored);

/// Adds footprints of this scale to the sorted photons. The workspace must hold their
/// differentials.
void add_footprints(Device& device, PhotonWorkspace& workspace, const FootprintScale& scale,
                    SortedPhotons& sorted);

} // namespace argand
