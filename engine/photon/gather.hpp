#pragma once

#include "photon/disc_settings.hpp"
#include "photon/estimator.hpp"

namespace argand {

/// Iterations of a query in one dispatch: well below 65,535, at which lavapipe ends loops silently.
inline constexpr std::uint32_t gather_budget = 16384;

/// Radii of density estimation, in the scene's units. Caustics are sharp, and have a radius of
/// their own, at most the other.
struct GatherRadii {
    double indirect = 0;
    double caustic = 0;
};

/// Density estimation over all photons within the radii, which are the same for all queries (as in
/// each pass of Hachisuka et al. 2008).
class RadiusEstimator final : public PhotonEstimator {
public:
    RadiusEstimator(Device& device, const Plan& plan, const GatherRadii& radii,
                    std::uint32_t budget = gather_budget, const DiscSettings& disc = {})
        : device_(device), plan_(plan), radii_(radii), budget_(budget), disc_(disc) {}

    void estimate(const PhotonMap& map, const PhotonQueries& queries) override;

private:
    void estimate_simultaneously(const PhotonMap& map, const PhotonQueries& queries);

    Device& device_;
    const Plan& plan_;
    GatherRadii radii_;
    std::uint32_t budget_;
    DiscSettings disc_;
};

/// Density estimation over the footprints that contain the query point (Fabianowski and Dingliana
/// 2009, eq. 1). The map must have footprints.
class FootprintEstimator final : public PhotonEstimator {
public:
    /// uniform_kernel: instead of Epanechnikov's.
    FootprintEstimator(Device& device, const Plan& plan, bool uniform_kernel = false,
                       std::uint32_t budget = gather_budget)
        : device_(device), plan_(plan), uniform_kernel_(uniform_kernel), budget_(budget) {}

    void estimate(const PhotonMap& map, const PhotonQueries& queries) override;

private:
    void estimate_simultaneously(const PhotonMap& map, const PhotonQueries& queries);

    Device& device_;
    const Plan& plan_;
    bool uniform_kernel_;
    std::uint32_t budget_;
};

} // namespace argand
