#pragma once

#include "photon/photon_map.hpp"
#include "photon/volume_tree.hpp"

namespace argand {

/// Boxes around the footprints of a map, in its order, as its own tree has them around its leaves.
/// Waits for the device.
std::vector<BoxRecord> footprint_boxes(Device& device, const PhotonMap& map);

/// The map with its photons and footprints in another order, and no tree yet. Waits for the device.
PhotonMap reordered(Device& device, const PhotonMap& map, const std::vector<std::uint32_t>& order);

/// The map, which must be in the order of the tree, with leaves of at most leaf_size photons (see
/// lay_out). The map given keeps its own tree and counters; photons and footprints are shared.
PhotonMap with_tree(Device& device, const PhotonMap& map, const VolumeTree& tree,
                    std::uint32_t leaf_size);

} // namespace argand
