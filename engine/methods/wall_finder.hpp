#pragma once

#include "photon/estimator.hpp"
#include "world/device_scene.hpp"

namespace argand {

/// Estimates as another estimator does, and takes the coverage from estimates whose photons lie
/// behind a wall: where it stands on a floor, the floor goes on behind it within the disc, in the
/// light of another room. Paths go on where coverage lacks. A ray from each query whose light comes
/// from one side finds the wall.
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
