#include "methods/cube_map_tracing.hpp"
#include "methods/fixed_radius.hpp"
#include "methods/photon_mapping.hpp"
#include "methods/render_options.hpp"
#include "methods/splats.hpp"

namespace argand {

namespace {

Option estimate_option() {
    Option option =
        own_choice_option("estimate",
                          "How densities are estimated: over discs of one radius, as photons "
                          "does, or over each photon's splat, as published",
                          {"discs", "splats"});
    option.sweep = {.full = {"splats"}, .matters = finds_photons};
    return option;
}

std::vector<Option> image_space_options() {
    std::vector<Option> own = fixed_radius_options();
    own.push_back(estimate_option());
    for (const std::vector<Option>& more : {splat_options(), cube_map_options()}) {
        own.insert(own.end(), more.begin(), more.end());
    }
    return all_photon_map_options(own);
}

} // namespace

/// Photons are traced through cube maps of the scene's surfaces; densities are those of `photons`,
/// or of splats.
MethodInfo image_space_method() {
    return {.name = "image-space",
            .summary = "photon mapping, photons traced through cube maps of the surfaces",
            .paper = "Yao et al. 2010",
            .abilities = {.photon_map = true, .approximate_hits = true},
            .law = photon_mapping_law,
            .options = image_space_options(),
            .make = [](RenderContext& context) {
                const bool splats = estimate_option().get(context.settings) == "splats";
                return make_photon_mapping(context,
                                           splats ? make_splats(context) : make_fixed_radius(),
                                           false, make_cube_map_tracing());
            }};
}

} // namespace argand
