#pragma once

#include "photon/estimator.hpp"
#include "world/device_scene.hpp"

namespace argand {

/// Estimates as another estimator does, and takes the coverage from estimates whose photons lie
/// behind a wall, so that eye paths go on there. Where a wall stands on a floor, the floor goes on
/// behind it, within the disc but in the light of another room. A ray from each query whose light
/// comes from one side finds the wall, or glass or a veil, which count as walls.
class WallFinder final : public PhotonEstimator {
public:
    /// rays, occluded: RayRecord and uint per slot of the queries, which are overwritten.
    WallFinder(Device& device, const DeviceScene& scene, PhotonEstimator& estimator,
               Traversal& traversal, const Buffer& rays, const Buffer& occluded)
        : device_(device), scene_(scene), estimator_(estimator), traversal_(traversal), rays_(rays),
          occluded_(occluded) {}

    void estimate(const PhotonMap& map, const PhotonQueries& queries) override;

private:
    Device& device_;
    const DeviceScene& scene_;
    PhotonEstimator& estimator_;
    Traversal& traversal_;
    const Buffer& rays_;
    const Buffer& occluded_;
};

} // namespace argand
