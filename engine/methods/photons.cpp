#include "methods/fixed_radius.hpp"
#include "methods/photon_mapping.hpp"
#include "methods/render_options.hpp"

namespace argand {

/// Density over discs of one radius, as in each pass of progressive photon mapping (Hachisuka et
/// al. 2008).
MethodInfo photons_method() {
    return {.name = "photons",
            .summary = "photon mapping, density over a fixed radius",
            .paper = "Jensen 1996; Hachisuka et al. 2008",
            .abilities = {.photon_map = true},
            .law = photon_mapping_law,
            .trial = TrialOrder::first,
            .options = photon_mapping_options(fixed_radius_options()),
            .make = [](RenderContext& context) {
                return make_photon_mapping(context, make_fixed_radius());
            }};
}

} // namespace argand
