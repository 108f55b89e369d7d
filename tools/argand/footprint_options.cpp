#include "footprint_options.hpp"

#include "numbers.hpp"
#include "shared/photon_records.h"

namespace argand {

void add_footprint_options(CLI::App& command, FootprintSettings& settings) {
    CLI::Option_group& group = *command.add_option_group("Method footprints");
    const auto number = [&](const char* name, double& value, const char* help, double low,
                            double high) {
        group.add_option(name, value, help)
            ->capture_default_str()
            ->check(number_between(low, high));
    };
    group
        .add_option("--smoothing", settings.smoothing,
                    "Size of footprints at 200,000 photons, in units of the scene's radius to the "
                    "power of 3/4 "
                    "(default: from the scene)")
        ->check(number_between(1e-9, 1e9));
    number("--caustic-smoothing", settings.caustic_smoothing,
           "Size of the footprints of caustics at 200,000 photons, in distances between photons",
           1e-3, 1e3);
    group
        .add_option(
            "--max-footprint", settings.largest,
            "Largest semi-axis of a footprint, in the scene's radii (default: from the scene)")
        ->check(number_between(1e-6, 10));
    number("--flatness", settings.flatness, "Height of a footprint over the mean of its semi-axes",
           1e-3, 10);
    group
        .add_option("--leaf-size", settings.leaf_size,
                    "Photons in a leaf of the map at most; 0: from the scene")
        ->capture_default_str()
        ->check(integer_between(0, most_photons_a_leaf));
    group.add_flag("--uniform-kernel", settings.uniform_kernel,
                   "A uniform kernel instead of Epanechnikov's");
    group.add_flag("--fixed-smoothing", settings.fixed_smoothing,
                   "Footprints shrink as n^(-1/2) with the number of photons, not as n^(-1/6)");
    group.add_flag(
        "--paper-axes", settings.paper_axes,
        "Compresses a footprint's differentials as they are, not the axes of its ellipse");
    group.add_flag(
        "--paper-reemission", settings.paper_reemission,
        "Diffuse reflection spaces photons evenly over the sphere, not as they are sampled");
}

} // namespace argand
