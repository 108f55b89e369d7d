#include "methods/fixed_radius.hpp"
#include "methods/photon_mapping.hpp"
#include "methods/render_options.hpp"

namespace argand {

namespace {

/// The radius that the last pass of a setting used, times a factor.
OptionSweep around_last_radius() {
    return {.around = [](const RenderStatistics& learnt,
                         double factor) { return around_width(learnt.radius, factor); },
            .matters = finds_photons};
}

/// The options of `photons`, but for those that fix the radius or ask for what this method is.
std::vector<Option> progressive_method_options() {
    std::vector<Option> options = photon_mapping_options(fixed_radius_options());
    std::erase_if(options, [](const Option& option) {
        return option.fixes_bandwidth || option.name == "progressive";
    });
    for (Option& option : options) {
        if (option.name == "r1") {
            option.sweep = around_last_radius();
        } else if (option.name == "passes") {
            option.sweep = {
                .quick = {"4", "16"}, .full = {"4", "16", "64"}, .matters = finds_photons};
        }
    }
    return options;
}

} // namespace

/// Progressive photon mapping: each pass with photons of its own and a smaller radius, without end.
MethodInfo progressive_method() {
    return {.name = "progressive",
            .summary = "photon mapping, density over a radius that falls from pass to pass",
            .paper = "Keller et al. 2010; Knaus and Zwicker 2011",
            .abilities = {.photon_map = true, .progressive = true},
            .law = progressive_law(ProgressiveSettings().exponent),
            .options = progressive_method_options(),
            .make = [](RenderContext& context) {
                return make_photon_mapping(context, make_fixed_radius(), true);
            }};
}

} // namespace argand
