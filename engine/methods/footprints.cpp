#include "methods/footprint_estimation.hpp"
#include "methods/photon_mapping.hpp"
#include "methods/render_options.hpp"
#include "methods/search_options.hpp"
#include "photon/gather.hpp"

namespace argand {

namespace {

/// Density over each photon's own footprint (Fabianowski and Dingliana 2009).
class Footprints : public EstimationStrategy {
public:
    Bandwidth learn(const FirstPass& first, const RenderSettings& settings) const override {
        Bandwidth bandwidth = learn_radii(first, settings);
        learn_smoothing(bandwidth, first, settings.footprints);
        return bandwidth;
    }

    std::optional<FootprintScale> footprints(const Bandwidth& bandwidth,
                                             const FootprintSettings& settings, double photons,
                                             const SceneRecord& scene) const override {
        return footprint_scale(bandwidth, settings, photons, scene);
    }

    bool parts_caustics(const Bandwidth& bandwidth, bool may_part) const override {
        return may_part && bandwidth.caustics;
    }

    std::unique_ptr<PhotonEstimator> make(const RenderContext& c, const PhotonMap&,
                                          const Bandwidth&) const override {
        return std::make_unique<FootprintEstimator>(c.device, c.on_device.plan,
                                                    c.settings.footprints.uniform_kernel);
    }
};

Option swept(Option option, std::vector<std::string> full) {
    option.sweep = {.full = std::move(full), .matters = finds_photons};
    return option;
}

Option smoothing_option() {
    Option option = member_option(
        "smoothing",
        "Size of footprints at 200,000 photons, in units of the scene's radius to the power of 3/4 "
        "(default: from the scene)",
        [](RenderSettings & s) -> auto& { return s.footprints.smoothing; }, 1e-9, 1e9);
    option.sweep = {.around = [](const RenderStatistics& learnt,
                                 double factor) { return around_width(learnt.smoothing, factor); },
                    .matters = finds_photons};
    return option;
}

Option caustic_smoothing_option() {
    Option option = member_option(
        "caustic-smoothing",
        "Size of the footprints of caustics at 200,000 photons, in distances between photons",
        [](RenderSettings & s) -> auto& { return s.footprints.caustic_smoothing; }, 1e-3, 1e3);
    option.sweep = {.full = {"2", "8"}, .matters = [](const Variation& variation) {
                        return variation.plan.needs(Feature::followed_paths) &&
                               finds_photons(variation);
                    }};
    return option;
}

} // namespace

std::unique_ptr<EstimationStrategy> make_footprints() { return std::make_unique<Footprints>(); }

std::vector<Option> footprint_options() {
    Option largest = member_option(
        "max-footprint",
        "Largest semi-axis of a footprint, in the scene's radii (default: from the scene)",
        [](RenderSettings & s) -> auto& { return s.footprints.largest; }, 1e-6, 10);
    largest.report_key = "largest_footprint";
    Option flatness = member_option(
        "flatness", "Height of a footprint over the mean of its semi-axes",
        [](RenderSettings & s) -> auto& { return s.footprints.flatness; }, 1e-3, 10);
    Option uniform = member_option(
        "uniform-kernel", "Use a uniform kernel instead of Epanechnikov's",
        [](RenderSettings & s) -> auto& { return s.footprints.uniform_kernel; });
    uniform.report_key = "kernel";
    Option fixed = member_option(
        "fixed-smoothing",
        "Shrink footprints as n^(-1/2) with the number n of photons, instead of n^(-1/6)",
        [](RenderSettings & s) -> auto& { return s.footprints.fixed_smoothing; });
    fixed.fixes_bandwidth = true;
    Option axes = member_option(
        "paper-axes",
        "Bound the lengths of a footprint's differentials instead of the axes of its ellipse",
        [](RenderSettings & s) -> auto& { return s.footprints.paper_axes; });
    Option reemission = member_option(
        "paper-reemission",
        "Space photons evenly over the sphere after diffuse reflection, not as they are sampled",
        [](RenderSettings & s) -> auto& { return s.footprints.paper_reemission; });
    return {smoothing_option(),
            caustic_smoothing_option(),
            largest,
            swept(flatness, {"0.1", "1"}),
            swept(uniform, {"on"}),
            fixed,
            swept(axes, {"on"}),
            swept(reemission, {"on"})};
}

MethodInfo footprints_method() {
    std::vector<Option> options = footprint_options();
    for (const Option& option : search_options()) {
        options.push_back(option);
    }
    return {.name = "footprints",
            .summary = "photon mapping, density over each photon's footprint",
            .paper = "Fabianowski and Dingliana 2009",
            .abilities = {.photon_map = true, .footprints = true},
            .law = photon_mapping_law,
            .trial = TrialOrder::later,
            .options = photon_mapping_options(options),
            .make = [](RenderContext& context) {
                return make_photon_mapping(context, make_footprints());
            }};
}

} // namespace argand
