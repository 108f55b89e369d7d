#include "methods/render_options.hpp"

#include "scene/texture_range.hpp"
#include "shared/follow.h"
#include "shared/photon_records.h"

#include <fmt/format.h>

namespace argand {

namespace {

bool has_estimated_light(const Variation& variation) {
    return variation.plan.needs(Feature::diffuse) ||
           variation.plan.needs(Feature::glossy_estimates);
}

bool looks_up_photons(const Variation& variation) {
    return has_estimated_light(variation) && variation.base.bounces > 0;
}

/// Whether the roughness up to which lobes are followed makes another choice of lobes.
bool follows_other_lobes(const Variation& variation) {
    const auto choice = [&](float roughness) {
        std::vector<std::uint32_t> lobes;
        for (const Material& material : variation.scene.materials) {
            for (const Material& variant : at_extreme_texels(variation.scene, material)) {
                lobes.push_back(followed_lobes(material_record(variant), roughness));
            }
        }
        return lobes;
    };
    return choice(variation.changed.follow_roughness) != choice(variation.base.follow_roughness);
}

Option photons_option() {
    Option option = member_option(
        "photons", "Photons emitted", [](RenderSettings & s) -> auto& { return s.photons; }, 0,
        4'000'000'000);
    option.sweep = {.quick = {"10000", "50000", "1000000"},
                    .full = {"10000", "30000", "100000", "300000", "1000000"},
                    .matters = looks_up_photons};
    return option;
}

Option radius_option() {
    // The square of the radius and its inverse are finite.
    Option option = member_option(
        "radius",
        "Radius of density estimation; with knn its maximum; with footprints it bounds their size "
        "(default: from the scene)",
        [](RenderSettings & s) -> auto& { return s.radius; }, 1e-18, 1e18);
    option.fixes_bandwidth = true;
    option.sweep = {.around = [](const RenderStatistics& learnt,
                                 double factor) { return around_width(learnt.radius, factor); },
                    .matters = finds_photons};
    return option;
}

Option query_cell_option() {
    Option option = member_option(
        "query-cell",
        "Edge of the cells in which eye paths share one estimate, in radii of estimation; 0: no "
        "sharing",
        [](RenderSettings & s) -> auto& { return s.query_cell; }, 0, 10);
    option.sweep = {.full = {"0", "0.5"}, .matters = finds_photons};
    return option;
}

Option least_coverage_option() {
    Option option = member_option(
        "least-coverage",
        "Least share of an estimate's disc on surfaces; where there is less, as on leaves and "
        "bars, or where its light is uneven, as in crevices, the eye path goes on instead; 0: it "
        "never does (default: 0.1, or 0.2 if --spp is 64 or more)",
        [](RenderSettings & s) -> auto& { return s.least_coverage; }, 0, 1);
    option.sweep = {.full = {"0", "0.2"}, .matters = finds_photons};
    return option;
}

Option near_field_option() {
    Option option = member_option(
        "near-field",
        "Distance within which eye paths follow the light of other surfaces instead of taking it "
        "from the photon map; 0: never (default: from the scene)",
        [](RenderSettings & s) -> auto& { return s.near_field; }, 0, 1e18);
    option.sweep = {.around = [](const RenderStatistics& learnt,
                                 double factor) { return around_width(learnt.near_field, factor); },
                    .matters = finds_photons};
    return option;
}

Option leaf_size_option() {
    Option option = member_option(
        "leaf-size", "Maximum number of photons in a leaf of the photon map; 0: 16",
        [](RenderSettings & s) -> auto& { return s.leaf_size; }, 0, most_photons_a_leaf);
    option.sweep = {.full = {"4", "16", "64"}, .matters = finds_photons};
    return option;
}

Option wide_codes_option() {
    Option option = member_option(
        "wide-codes",
        "Sort photons by 63-bit codes instead of 30-bit ones: for photons in a few places far from "
        "each other",
        [](RenderSettings & s) -> auto& { return s.wide_codes; });
    option.sweep = {.full = {"on"}, .matters = finds_photons};
    return option;
}

Option photon_sampling_option() {
    Option option{.name = "photon-sampling",
                  .help = "Sequence of numbers that decides the paths of photons",
                  .kind = OptionKind::choice,
                  .choices = {"sobol", "random"},
                  .report_key = "photon_sampling",
                  .get =
                      [](const RenderSettings& settings) {
                          return settings.photon_sampling == Sampling::sobol ? "sobol" : "random";
                      },
                  .set =
                      [](RenderSettings& settings, const std::string& text) {
                          settings.photon_sampling =
                              text == "random" ? Sampling::random : Sampling::sobol;
                      },
                  .sweep = {.full = {"random"}, .matters = finds_photons}};
    return option;
}

Option final_gather_option() {
    Option option = member_option(
        "final-gather",
        "Look up the photon map one bounce later, except for caustics: noise instead of blotches",
        [](RenderSettings & s) -> auto& { return s.final_gather; });
    option.sweep = {.full = {"on"}, .matters = finds_photons};
    return option;
}

} // namespace

bool finds_photons(const Variation& variation) {
    return looks_up_photons(variation) && variation.base.photons > 0;
}

Option own_choice_option(const std::string& name, const std::string& help,
                         const std::vector<std::string>& choices) {
    Option option = own_option(name, help, OptionKind::choice, choices.front());
    option.choices = choices;
    return option;
}

Option own_number_option(const std::string& name, const std::string& help, OptionKind kind,
                         const std::string& initially, double low, double high) {
    Option option = own_option(name, help, kind, initially);
    option.low = low;
    option.high = high;
    option.sweep.matters = finds_photons;
    return option;
}

std::string around_width(double learnt, double factor) {
    return learnt > 0 ? fmt::format("{:.3g}", factor * learnt) : "";
}

Option samples_option() {
    Option option = member_option(
        "spp", "Eye paths per pixel; at least one for each pass of 262,144 photons",
        [](RenderSettings & s) -> auto& { return s.samples; }, 1, 1 << 24);
    option.sweep = {.quick = {"32"}, .full = {"2", "4", "16", "32"}};
    return option;
}

Option bounces_option() {
    Option option = member_option(
        "bounces",
        "Indirect bounces; 0: direct light only (default: unlimited, with Russian roulette)",
        [](RenderSettings & s) -> auto& { return s.bounces; }, 0, unlimited_bounces);
    option.get = [](const RenderSettings& settings) {
        return settings.bounces == unlimited_bounces ? "auto" : value_text(settings.bounces);
    };
    option.set = [](RenderSettings& settings, const std::string& text) {
        std::optional<std::uint32_t> bounces;
        read_value("bounces", text, bounces);
        settings.bounces = bounces.value_or(unlimited_bounces);
    };
    option.sweep = {.full = {"1", "4"}, .matters = has_estimated_light};
    return option;
}

Option follow_roughness_option() {
    Option option = member_option(
        "follow-roughness",
        "Glossy reflection up to this roughness is followed from the eye like a mirror; rougher "
        "reflection is estimated",
        [](RenderSettings & s) -> auto& { return s.follow_roughness; }, 0, 1);
    option.sweep = {.full = {"0", "0.5"}, .matters = [](const Variation& variation) {
                        const bool glossy = variation.plan.needs(Feature::ggx) ||
                                            variation.plan.needs(Feature::phong);
                        return glossy && looks_up_photons(variation) &&
                               follows_other_lobes(variation);
                    }};
    return option;
}

Option deterministic_option() {
    return member_option(
        "deterministic",
        "Decide all paths by the points of a lattice, without scrambling and without a seed",
        [](RenderSettings & s) -> auto& { return s.deterministic; });
}

Option cull_back_faces_option() {
    return member_option(
        "cull-back-faces",
        "Do not show one-sided surfaces from behind, as rasterisers do; they still block light",
        [](RenderSettings & s) -> auto& { return s.cull_back_faces; });
}

Option aperture_option() {
    // Its product with 1 / focus, and the square of that, are finite.
    return member_option(
        "aperture", "Diameter of the camera's lens, in the scene's units (metres); 0: all is sharp",
        [](RenderSettings & s) -> auto& { return s.aperture; }, 0, 1e9);
}

Option focus_option() {
    return member_option(
        "focus",
        "With --aperture: distance along the camera's axis at which the picture is sharp "
        "(default: that of what is in its middle)",
        [](RenderSettings & s) -> auto& { return s.focus; }, 1e-9, 1e9);
}

Option filter_option() {
    static constexpr const char* names[] = {"box", "blackman-harris"};
    return {.name = "filter",
            .help =
                "How the samples of a pixel are placed: evenly in it (box), or by a window that "
                "reaches 1.5 pixels from its middle, which shows edges without steps "
                "(blackman-harris)",
            .kind = OptionKind::choice,
            .choices = {names[0], names[1]},
            .report_key = "filter",
            .get = [](const RenderSettings& settings) -> std::string {
                return names[static_cast<int>(settings.filter)];
            },
            .set =
                [](RenderSettings& settings, const std::string& text) {
                    settings.filter =
                        text == names[1] ? PixelFilter::blackman_harris : PixelFilter::box;
                },
            .sweep = {}};
}

std::vector<Option> photon_map_options() {
    return {photons_option(),         radius_option(),      query_cell_option(),
            least_coverage_option(),  leaf_size_option(),   wide_codes_option(),
            photon_sampling_option(), final_gather_option()};
}

std::vector<Option> progressive_options() {
    Option progressive = member_option(
        "progressive",
        "Let the widths of estimation fall from pass to pass, so that the picture converges to the "
        "truth however many passes there are",
        [](RenderSettings & s) -> auto& { return s.progressive.on; });
    Option passes = member_option(
        "passes", "Progressive passes, each of --photons (with knn more, once k is 8) and --spp",
        [](RenderSettings & s) -> auto& { return s.progressive.passes; }, 1, 1'000'000'000);
    passes.ends_render = true;
    Option first_radius = member_option(
        "r1",
        "Radius of the first progressive pass; with knn its maximum; with footprints it bounds "
        "their size (default: from the scene)",
        [](RenderSettings & s) -> auto& { return s.progressive.first_radius; }, 1e-18, 1e18);
    Option exponent = member_option(
        "radius-exponent",
        "a of the progressive radius r1 (n / n1)^(-a), n photons so far and n1 in the first pass, "
        "between 0 and 1/2: larger ones lower the bias faster, and the noise more slowly",
        [](RenderSettings & s) -> auto& { return s.progressive.exponent; }, 1e-6, 0.499999);
    return {progressive, passes, first_radius, exponent};
}

std::vector<Option> photon_mapping_options(const std::vector<Option>& own) {
    std::vector<Option> options = all_photon_map_options(own);
    options.push_back(near_field_option());
    return options;
}

std::vector<Option> all_photon_map_options(const std::vector<Option>& own) {
    std::vector<Option> options{
        samples_option(),  bounces_option(), follow_roughness_option(), cull_back_faces_option(),
        aperture_option(), focus_option(),   filter_option(),           deterministic_option()};
    for (const std::vector<Option>& more : {photon_map_options(), progressive_options(), own}) {
        options.insert(options.end(), more.begin(), more.end());
    }
    return options;
}

} // namespace argand
