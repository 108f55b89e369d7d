#include "photon/vvh.hpp"

#include "shared/footprint.h"
#include "shared/photon.h"

#include <algorithm>

namespace argand {

namespace {

std::uint32_t stored(Device& device, const PhotonMap& map) {
    return download_word(device, map.counters, counter_stored);
}

template <class Record>
Buffer in_order(Device& device, const char* name, const Buffer& records,
                const std::vector<std::uint32_t>& order) {
    const std::vector<Record> before = download<Record>(device, records, order.size());
    std::vector<Record> after;
    after.reserve(std::max<std::size_t>(order.size(), 1));
    for (const std::uint32_t i : order) {
        after.push_back(before[i]);
    }
    after.resize(std::max<std::size_t>(order.size(), 1)); // no buffer is empty
    return upload(device, name, after);
}

} // namespace

std::vector<BoxRecord> footprint_boxes(Device& device, const PhotonMap& map) {
    const std::uint32_t count = stored(device, map);
    const auto photons = download<PhotonRecord>(device, map.photons, count);
    const auto footprints = download<glm::uvec4>(device, map.footprints, count);
    std::vector<BoxRecord> boxes;
    boxes.reserve(count);
    for (std::size_t i = 0; i < count; ++i) {
        const PhotonRecord& p = photons[i];
        const FootprintDuals duals = unpack_duals(footprints[i]);
        const Footprint f = footprint_of_duals(duals, unpack_photon_normal(p.normal), map.flatness);
        // Enlarged as in photon_boxes.h.
        const vec3 half_size = footprint_extent(f) * 1.001f;
        boxes.push_back({p.x - half_size.x, p.y - half_size.y, p.z - half_size.z, 0,
                         p.x + half_size.x, p.y + half_size.y, p.z + half_size.z, 0});
    }
    return boxes;
}

PhotonMap reordered(Device& device, const PhotonMap& map, const std::vector<std::uint32_t>& order) {
    PhotonMap result = map;
    result.photons =
        in_order<PhotonRecord>(device, "photons, in the order of a tree", map.photons, order);
    result.footprints = in_order<glm::uvec4>(device, "photon footprints, in the order of a tree",
                                             map.footprints, order);
    result.lbvh = {};
    return result;
}

PhotonMap with_tree(Device& device, const PhotonMap& map, const VolumeTree& tree,
                    std::uint32_t leaf_size) {
    LaidOutTree laid_out = lay_out(tree, leaf_size);
    std::vector<std::uint32_t> counters =
        download<std::uint32_t>(device, map.counters, counter_count);
    counters[counter_leaves] = static_cast<std::uint32_t>(laid_out.leaves.size());
    laid_out.nodes.resize(std::max<std::size_t>(laid_out.nodes.size(), 1));
    laid_out.leaves.resize(std::max<std::size_t>(laid_out.leaves.size(), 1));
    PhotonMap result = map;
    result.counters = upload(device, "photon counters of a tree", counters);
    result.lbvh.order = upload(device, "photon map leaves of a tree", laid_out.leaves);
    result.lbvh.nodes = upload(device, "photon map nodes of a tree", laid_out.nodes);
    result.leaf_size = leaf_size;
    return result;
}

} // namespace argand
