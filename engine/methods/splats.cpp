#include "methods/splats.hpp"

#include "base/error.hpp"
#include "methods/render_options.hpp"
#include "photon/gather.hpp"
#include "shared/footprint.h"

#include <cmath>

namespace argand {

namespace {

constexpr double smallest_value = 1e-6;
constexpr double largest_value = 1e6;

bool matters_to_splats(const Variation& variation) {
    const auto estimate = variation.changed.own.find("estimate");
    return finds_photons(variation) && estimate != variation.changed.own.end() &&
           estimate->second == "splats";
}

Option size_option() {
    Option option = own_number_option(
        "splat-size",
        "Radius of splats of density 1, C0 in the paper: in the square root of the "
        "surfaces' area over the photons of a pass (default: the radius over "
        "which discs would estimate)",
        OptionKind::number, "auto", smallest_value, largest_value);
    option.sweep.matters = matters_to_splats;
    return option;
}

Option density_option(const std::string& name, const std::string& help,
                      const std::string& initially) {
    Option option =
        own_number_option(name, help, OptionKind::number, initially, smallest_value, largest_value);
    option.sweep.matters = matters_to_splats;
    return option;
}

Option least_option() {
    Option option = density_option(
        "least-density",
        "Density from which on a splat does not grow: the cosine at which the photon arrives over "
        "the square of the distance from which it comes, in the scene's radii",
        "0.5");
    option.sweep.full = {"0.25", "1"};
    return option;
}

Option most_option() {
    Option option =
        density_option("most-density", "Density from which on a splat does not shrink", "4");
    option.sweep.full = {"1", "16"};
    return option;
}

/// Splats of Yao et al. 2010.
class Splats : public EstimationStrategy {
public:
    explicit Splats(const RenderContext& context) : c_(context) {}

    bool splats() const override { return true; }

    std::optional<FootprintScale> footprints(const Bandwidth& bandwidth, const FootprintSettings&,
                                             double photons,
                                             const SceneRecord& scene) const override {
        glm::vec2 sizes(bandwidth.radii.indirect, bandwidth.radii.caustic);
        if (size_option().get(c_.settings) != "auto") {
            sizes = glm::vec2(own_number(c_.settings, size_option()) *
                              std::sqrt(c_.on_device.surface_area / std::max(photons, 1.0)));
        }
        const glm::vec2 densities(own_number(c_.settings, least_option()),
                                  own_number(c_.settings, most_option()));
        return splat_scale(sizes, scene.radius, densities,
                           static_cast<float>(c_.settings.footprints.flatness));
    }

    bool parts_caustics(const Bandwidth& bandwidth, bool may_part) const override {
        return parts_sharp_caustics(bandwidth, may_part);
    }

    std::unique_ptr<PhotonEstimator> make(const RenderContext& c, const PhotonMap&,
                                          const Bandwidth&) const override {
        return std::make_unique<FootprintEstimator>(c.device, c.on_device.plan,
                                                    c.settings.disc.uniform_kernel);
    }

private:
    const RenderContext& c_;
};

} // namespace

std::unique_ptr<EstimationStrategy> make_splats(const RenderContext& context) {
    const RenderSettings& settings = context.settings;
    if (own_number(settings, least_option()) > own_number(settings, most_option())) {
        throw UsageError(fmt::format("estimating by splats: --least-density {} is above "
                                     "--most-density {}; exchange them, or give both",
                                     least_option().get(settings), most_option().get(settings)));
    }
    if (settings.disc.ball) {
        throw UsageError("estimating by splats: --support ball is for --estimate discs; leave it "
                         "out");
    }
    return std::make_unique<Splats>(context);
}

std::vector<Option> splat_options() { return {size_option(), least_option(), most_option()}; }

} // namespace argand
