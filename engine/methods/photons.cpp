#include "methods/photon_mapping.hpp"
#include "methods/render_options.hpp"
#include "photon/gather.hpp"

namespace argand {

namespace {

/// Density over discs of one radius, as in each pass of progressive photon mapping (Hachisuka et
/// al. 2008). Caustics have a radius of their own.
class FixedRadius : public EstimationStrategy {
public:
    QuerySharing sharing(const Bandwidth& bandwidth, double cell, bool may_part) const override {
        const bool sharp = bandwidth.radii.caustic < bandwidth.radii.indirect;
        return {.cell = cell,
                .caustics_apart = may_part && bandwidth.caustics && sharp,
                .sharp_caustics = sharp};
    }

    std::unique_ptr<PhotonEstimator> make(const RenderContext& c, const PhotonMap&,
                                          const Bandwidth& bandwidth) const override {
        return std::make_unique<RadiusEstimator>(c.device, c.on_device.plan, bandwidth.radii);
    }
};

} // namespace

MethodInfo photons_method() {
    return {.name = "photons",
            .summary = "photon mapping, density over a fixed radius",
            .paper = "Jensen 1996; Hachisuka et al. 2008",
            .abilities = {.photon_map = true},
            .law = photon_mapping_law,
            .trial = TrialOrder::first,
            .options = all_photon_map_options({}),
            .make = [](RenderContext& context) {
                return make_photon_mapping(context, std::make_unique<FixedRadius>());
            }};
}

} // namespace argand
