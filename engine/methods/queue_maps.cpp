#include "methods/queue_maps.hpp"

#include "photon/queue_kdtree.hpp"

namespace argand {

namespace {

/// The map over the same records with the tree that other methods build.
PhotonMap with_lbvh(RenderContext& c, const PhotonQueue& queue, PhotonWorkspace& workspace,
                    const QueueMapSettings& settings, const PhotonMap& map) {
    PhotonMap result = build_photon_map(
        c.device, c.on_device, workspace, {.slots = queue.entries, .photons = queue.entries},
        {.leaf_size = c.settings.leaf_size, .footprints = settings.scale});
    result.area_samples = map.area_samples;
    result.corrected = map.corrected;
    return result;
}

/// The map over the same records with a kd-tree of their own.
PhotonMap with_kdtree(RenderContext& c, const PhotonQueue& queue, PhotonWorkspace& workspace,
                      const QueueMapSettings& settings, const PhotonMap& map,
                      const std::optional<QueueFootprints>& footprints) {
    PhotonQueue sorted = sort_by_kdtree(c.device, workspace, queue.entries, settings.reach,
                                        queue.leaf_size, queue.caustic > 0);
    sorted.area_scale = queue.area_scale;
    PhotonMap result = map_of_queue(c.device, sorted, map.corrected, footprints);
    result.area_samples = map.area_samples;
    return result;
}

} // namespace

PhotonMap make_queue_map(RenderContext& c, PhotonQueue& queue, PhotonWorkspace& workspace,
                         const QueueMapSettings& settings) {
    std::optional<QueueFootprints> footprints;
    if (settings.scale) {
        footprints.emplace(QueueFootprints{c.on_device, *settings.scale});
    }
    if (settings.rebuild == QueueRebuild::none) {
        return map_of_queue(c.device, queue, settings.corrected, footprints);
    }
    // Only the photons' order, place and weight.
    const PhotonMap map = map_of_queue(c.device, queue, settings.corrected);
    copy_to_workspace(c.device, queue, map.photons, workspace);
    return settings.rebuild == QueueRebuild::lbvh
               ? with_lbvh(c, queue, workspace, settings, map)
               : with_kdtree(c, queue, workspace, settings, map, footprints);
}

} // namespace argand
