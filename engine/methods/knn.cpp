#include "methods/photon_mapping.hpp"
#include "methods/render_options.hpp"
#include "photon/nearest.hpp"

#include <algorithm>
#include <cmath>

namespace argand {

namespace {

// Radius of a typical estimate over r_max: queries use their own discs, of which many are smaller
// than the median.
constexpr double typical_over_max = 0.3;
// r_max over the radius that holds k photons in the median.
constexpr double reach = 2.5;

/// Density over the disc that the k nearest photons fill (Jensen 1996).
class Nearest : public EstimationStrategy {
public:
    Bandwidth learn(const FirstPass& first, const RenderSettings& settings) const override {
        Bandwidth bandwidth = learn_radii(first, settings, settings.neighbours);
        const auto stored = static_cast<double>(first.stored.photons);
        const double automatic = std::max(std::round(in_disc_of_pass(stored, first.passes)), 2.0);
        bandwidth.neighbours = settings.neighbours.value_or(static_cast<std::uint32_t>(automatic));
        bandwidth.radii.indirect *= settings.radius ? 1 : reach;
        bandwidth.radii.caustic = bandwidth.radii.indirect;
        return bandwidth;
    }

    double typical_radius(const Bandwidth& bandwidth) const override {
        return typical_over_max * bandwidth.radii.indirect;
    }

    QuerySharing sharing(const Bandwidth& bandwidth, double cell,
                         bool /*may_part*/) const override {
        // The nearest photons may be caustic ones, and then very near.
        return {.cell = cell, .pixel_sized = bandwidth.caustics};
    }

    std::unique_ptr<PhotonEstimator> make(const RenderContext& c, const PhotonMap& map,
                                          const Bandwidth& bandwidth) const override {
        const double samples_per_area = map.area_samples / std::max(c.on_device.areas.area, 1e-30);
        return std::make_unique<NearestEstimator>(
            c.device, c.on_device.plan,
            NearestSettings{.neighbours = bandwidth.neighbours,
                            .radius = bandwidth.radii.indirect,
                            .samples_per_area = samples_per_area});
    }
};

Option neighbours_option() {
    Option option = member_option(
        "k", "Photons that each estimate takes, the nearest (default: from the photons stored)",
        [](RenderSettings & s) -> auto& { return s.neighbours; }, 1, 0xffffffff);
    option.fixes_bandwidth = true;
    option.sweep = {.around =
                        [](const RenderStatistics& learnt, double factor) {
                            if (learnt.neighbours == 0) {
                                return std::string();
                            }
                            // One photon has no area.
                            return value_text(static_cast<std::uint32_t>(
                                std::max(factor * learnt.neighbours, 2.0)));
                        },
                    .matters = finds_photons};
    return option;
}

} // namespace

MethodInfo knn_method() {
    return {.name = "knn",
            .summary = "photon mapping, density over the k nearest photons",
            .paper = "Jensen 1996",
            .abilities = {.photon_map = true},
            .law = photon_mapping_law,
            .options = all_photon_map_options({neighbours_option()}),
            .make = [](RenderContext& context) {
                return make_photon_mapping(context, std::make_unique<Nearest>());
            }};
}

} // namespace argand
