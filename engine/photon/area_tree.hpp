#pragma once

#include "accel/lbvh.hpp"

#include <cstdint>

namespace argand {

/// The area samples of a photon map alone, and a hierarchy over blocks of them. A map has several
/// photons for each sample, and its boxes may bound footprints; a walk that wants only the samples
/// around a point reads a tenth of the records here.
struct AreaTree {
    Buffer places; ///< uint per sample: its index among the map's records, in their order
    Lbvh lbvh;     ///< a leaf's box has the index of its block (area_block samples)
    std::uint32_t samples = 0; ///< 0: there is no tree
    double samples_per_area = 0;
};

/// Builds the tree over the samples among these PhotonRecords. counters: counter_* of
/// shared/photon_records.h; counter_stored is the number of records, counter_area_places becomes
/// that of samples. most_samples: bound of the latter. Waits for the device.
AreaTree build_area_tree(Device& device, const Buffer& records, const Buffer& counters,
                         std::uint32_t most_samples);

} // namespace argand
