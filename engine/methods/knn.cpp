#include "methods/nearest_photons.hpp"
#include "methods/photon_mapping.hpp"
#include "methods/render_options.hpp"
#include "photon/gather.hpp"
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

std::uint32_t automatic_neighbours(double photons, const FirstPass& first, bool caustic) {
    return static_cast<std::uint32_t>(
        std::max(std::round(in_disc_of_pass(photons, first.passes, caustic)), 2.0));
}

/// Density over the disc that the k nearest photons fill (Jensen 1996). Caustic photons have a k
/// and an r_max of their own, as in Jensen's caustic map: where they counted among the others, the
/// disc of every point around a caustic reached as far as the caustic, and spread its light.
class Nearest : public EstimationStrategy {
public:
    Bandwidth learn(const FirstPass& first, const RenderSettings& settings) const override {
        Bandwidth bandwidth =
            learn_radii(first, settings, settings.neighbours, settings.caustic_neighbours);
        bandwidth.neighbours =
            settings.neighbours.value_or(automatic_neighbours(first.photons.others, first, false));
        if (bandwidth.caustics) {
            bandwidth.caustic_neighbours = settings.caustic_neighbours.value_or(
                automatic_neighbours(first.photons.caustics, first, true));
        }
        if (!settings.radius) {
            bandwidth.radii.indirect *= reach;
            bandwidth.radii.caustic *= reach;
        }
        return bandwidth;
    }

    // k photons fill a small disc where most of them carry little flux. One that carries much would
    // be a firefly there.
    bool takes_uneven_photons() const override { return false; }

    double typical_radius(const Bandwidth& bandwidth) const override {
        return typical_over_max * bandwidth.radii.indirect;
    }

    bool parts_caustics(const Bandwidth& bandwidth, bool /*may_part*/) const override {
        return bandwidth.caustics; // they have a k of their own
    }

    double caustic_discs(const Bandwidth& bandwidth) const override {
        return bandwidth.caustics ? bandwidth.radii.caustic : 0;
    }

    std::unique_ptr<PhotonEstimator> make(const RenderContext& c, const PhotonMap& map,
                                          const Bandwidth& bandwidth) const override {
        return std::make_unique<NearestEstimator>(
            c.device, c.on_device.plan,
            NearestSettings{.neighbours = bandwidth.neighbours,
                            .radius = bandwidth.radii.indirect,
                            .samples_per_area = samples_per_area(c.on_device, map.area_samples),
                            .caustic_neighbours = bandwidth.caustic_neighbours,
                            .caustic_radius = bandwidth.radii.caustic});
    }

    // The discs of k photons reach far in the dark, and hold many photons. These queries hardly
    // share answers, so they would take most of the time.
    std::unique_ptr<PhotonEstimator> make_for_gathers(const RenderContext& c,
                                                      const Bandwidth& bandwidth) const override {
        const GatherRadii median{bandwidth.radii.indirect / reach, bandwidth.radii.caustic / reach};
        return std::make_unique<RadiusEstimator>(c.device, c.on_device.plan, median);
    }
};

Option neighbours_option() {
    Option option = member_option(
        "k",
        "Photons that each estimate takes, the nearest; in the first pass if progressive (default: "
        "from the photons stored)",
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

Option caustic_neighbours_option() {
    Option option = member_option(
        "caustic-k", "The same for caustics (default: from the caustic photons stored)",
        [](RenderSettings & s) -> auto& { return s.caustic_neighbours; }, 1, 0xffffffff);
    option.fixes_bandwidth = true;
    return option;
}

} // namespace

std::unique_ptr<EstimationStrategy> make_nearest() { return std::make_unique<Nearest>(); }

std::vector<Option> nearest_options() { return {neighbours_option(), caustic_neighbours_option()}; }

MethodInfo knn_method() {
    return {.name = "knn",
            .summary = "photon mapping, density over the k nearest photons",
            .paper = "Jensen 1996",
            .abilities = {.photon_map = true},
            .law = photon_mapping_law,
            .options = photon_mapping_options(nearest_options()),
            .make = [](RenderContext& context) {
                return make_photon_mapping(context, make_nearest());
            }};
}

} // namespace argand
