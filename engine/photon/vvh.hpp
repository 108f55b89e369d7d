#pragma once

#include "photon/photon_map.hpp"
#include "photon/volume_tree.hpp"

namespace argand {

/// Boxes around the footprints of a map, in its order and as large as those from which the leaves'
/// boxes of its own tree are made. Waits for the device.
std::vector<BoxRecord> footprint_boxes(Device& device, const PhotonMap& map);

/// The map with its photons and footprints in another order, and no tree yet. Waits for the device.
PhotonMap reordered(Device& device, const PhotonMap& map, const std::vector<std::uint32_t>& order);

/// The map with another tree, whose leaves hold at most leaf_size photons (see lay_out). The map
/// must be in the order of the tree. Both maps share photons and footprints.
PhotonMap with_tree(Device& device, const PhotonMap& map, const VolumeTree& tree,
                    std::uint32_t leaf_size);

} // namespace argand
