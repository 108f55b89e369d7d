#include "methods/cube_map_options.hpp"

#include "methods/cube_map_tracing.hpp"
#include "methods/render_options.hpp"

namespace argand {

namespace {

Option count_option() {
    Option option =
        own_number_option("maps-count",
                          "Maps through which photons are traced, at most; fewer if these "
                          "show all (default: as many as --coverage requires)",
                          OptionKind::integer, "auto", 1, most_centers);
    option.sweep.full = {"4", "16"};
    return option;
}

Option making_option() {
    Option option =
        own_choice_option("maps",
                          "How maps are made: drawn by the device's rasteriser, or by casting "
                          "rays; auto: drawn, unless the device has none or is a CPU",
                          {"auto", "raster", "cast"});
    option.sweep.matters = finds_photons;
    return option;
}

Option size_option() {
    Option option =
        own_number_option("map-size",
                          "Texels along the edge of a map's six faces; halved until the maps fit "
                          "into a buffer of the device",
                          OptionKind::integer, "128", 1, 2048);
    option.sweep.full = {"64", "256"};
    return option;
}

Option coverage_option() {
    return own_number_option(
        "coverage",
        "Maps are added until they show this share of the points in view and of "
        "the places where photons lie, and until the best further one would add "
        "less than the rest to the area that they show",
        OptionKind::number, "0.99", 0, 1);
}

Option choose_every_option() {
    return own_number_option(
        "choose-every",
        "Images of a film for which centers of maps are chosen once, unless they "
        "show less of what is in view; 1: an image does not depend on those before",
        OptionKind::integer, "1", 1, 1'000'000);
}

Option steps_option() {
    return own_number_option("steps", "Iterations in which a photon's hit is found in a map",
                             OptionKind::integer, "5", 0, 64);
}

Option march_option() {
    Option option =
        own_number_option("march",
                          "Directions in which a map is looked at along a photon's way, "
                          "before the iterations; 0: they begin as published",
                          OptionKind::integer, "32", 0, 4096);
    option.sweep.full = {"16", "64"};
    return option;
}

Option hits_option() {
    Option option =
        own_choice_option("map-hits",
                          "What a photon hits in a map: the triangle that a texel shows, or "
                          "the point in the texel's middle, as published",
                          {"triangles", "points"});
    option.sweep = {.full = {"points"}, .matters = finds_photons};
    return option;
}

Option shadows_option() {
    Option option = own_choice_option(
        "shadows",
        "What decides whether lights are seen: rays through the tree, or the maps; those around a "
        "point light are then its shadow maps, as published",
        {"rays", "maps"});
    option.sweep.full = {"maps"};
    return option;
}

Option reflections_option() {
    return own_choice_option("reflections",
                             "How eye paths go on behind the first surface: by rays through the "
                             "tree, or through the maps, as published",
                             {"rays", "maps"});
}

Option error_option() {
    return own_number_option(
        "map-error",
        "With --map-hits points: one minus the cosine of the angle by which a hit "
        "may lie off the photon's way",
        OptionKind::number, "0.001", 0, 2);
}

std::uint32_t whole(const RenderSettings& settings, const Option& option) {
    return static_cast<std::uint32_t>(own_number(settings, option));
}

} // namespace

CubeMapOptions cube_map_options_of(const RenderSettings& settings) {
    CubeMapOptions options;
    if (count_option().get(settings) != "auto") {
        options.centers.least = options.centers.most = whole(settings, count_option());
    }
    options.centers.coverage = own_number(settings, coverage_option());
    const std::string& making = making_option().get(settings);
    if (making != "auto") {
        options.making = making == "raster" ? MapMaking::raster : MapMaking::cast;
    }
    options.size = whole(settings, size_option());
    options.choose_every = whole(settings, choose_every_option());
    options.search = {.steps = whole(settings, steps_option()),
                      .march = whole(settings, march_option()),
                      .exact = hits_option().get(settings) == "triangles",
                      .tolerance = own_number(settings, error_option())};
    options.for_shadows = shadows_option().get(settings) == "maps";
    options.for_scattered = reflections_option().get(settings) == "maps";
    return options;
}

std::vector<Option> cube_map_options() {
    return {choose_every_option(), count_option(),   size_option(),       coverage_option(),
            making_option(),       steps_option(),   march_option(),      hits_option(),
            error_option(),        shadows_option(), reflections_option()};
}

} // namespace argand
