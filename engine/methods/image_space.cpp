#include "methods/cube_map_tracing.hpp"
#include "methods/fixed_radius.hpp"
#include "methods/photon_mapping.hpp"
#include "methods/render_options.hpp"

namespace argand {

namespace {

std::vector<Option> image_space_options() {
    std::vector<Option> own = fixed_radius_options();
    for (const Option& option : cube_map_options()) {
        own.push_back(option);
    }
    return all_photon_map_options(own);
}

} // namespace

/// Photons are traced through cube maps of the scene's surfaces; densities are those of `photons`.
MethodInfo image_space_method() {
    return {.name = "image-space",
            .summary = "photon mapping, photons traced through cube maps of the surfaces",
            .paper = "Yao et al. 2010",
            .abilities = {.photon_map = true, .approximate_hits = true},
            .law = photon_mapping_law,
            .options = image_space_options(),
            .make = [](RenderContext& context) {
                return make_photon_mapping(context, make_fixed_radius(), false,
                                           make_cube_map_tracing());
            }};
}

} // namespace argand
