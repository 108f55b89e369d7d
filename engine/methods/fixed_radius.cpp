#include "methods/fixed_radius.hpp"

#include "methods/render_options.hpp"
#include "methods/search_options.hpp"
#include "photon/gather.hpp"

namespace argand {

namespace {

class FixedRadius : public EstimationStrategy {
public:
    bool corrects_boundaries(const RenderSettings& settings) const override {
        return !settings.disc.ball;
    }

    bool parts_caustics(const Bandwidth& bandwidth, bool may_part) const override {
        return parts_sharp_caustics(bandwidth, may_part);
    }

    double caustic_discs(const Bandwidth& bandwidth) const override {
        return has_sharp_caustics(bandwidth) ? bandwidth.radii.caustic : 0;
    }

    std::unique_ptr<PhotonEstimator> make(const RenderContext& c, const PhotonMap&,
                                          const Bandwidth& bandwidth) const override {
        return std::make_unique<RadiusEstimator>(c.device, c.on_device.plan, bandwidth.radii,
                                                 gather_budget, c.settings.disc);
    }
};

/// A choice between two values, of which `member` holds whether it is the second.
template <class Member>
Option choice_of_two(const std::string& name, const std::string& help,
                     const std::vector<std::string>& choices, Member member) {
    return {.name = name,
            .help = help,
            .kind = OptionKind::choice,
            .choices = choices,
            .report_key = key_of(name),
            .get =
                [=](const RenderSettings& settings) {
                    RenderSettings copy = settings;
                    return choices[member(copy) ? 1 : 0];
                },
            .set = [=](RenderSettings& settings,
                       const std::string& text) { member(settings) = text == choices[1]; },
            .sweep = {.full = {choices[1]}, .matters = finds_photons}};
}

} // namespace

std::unique_ptr<EstimationStrategy> make_fixed_radius() { return std::make_unique<FixedRadius>(); }

std::vector<Option> fixed_radius_options() {
    std::vector<Option> options{
        choice_of_two(
            "kernel", "Weight of the photons within the radius", {"epanechnikov", "uniform"},
            [](RenderSettings & s) -> auto& { return s.disc.uniform_kernel; }),
        choice_of_two(
            "support",
            "Photons that count: those of the query's surface, corrected where little of the "
            "disc lies on surfaces, or all in a ball, uncorrected",
            {"disc", "ball"}, [](RenderSettings & s) -> auto& { return s.disc.ball; })};
    for (const Option& option : search_options()) {
        options.push_back(option);
    }
    return options;
}

} // namespace argand
