#include "table.hpp"

#include "maths_functions.h"

namespace argand::testing {

namespace {

constexpr auto ulp = Measure::ulp;
constexpr auto conditioned = Measure::conditioned;

void put_words(Draw& d, int count) {
    const std::uint32_t ends[] = {0, 1, 0x80000000u, 0xffffffffu};
    for (int i = 0; i < count; ++i) {
        d.put_word(d.once_in(6) ? ends[d.bits() % 4] : static_cast<std::uint32_t>(d.bits()));
    }
}

/// A point in or near a box, and the box's corners.
void put_point_and_box(Draw& d) {
    const glm::vec3 low = d.vector(-20, 20);
    glm::vec3 size = glm::abs(d.vector(-10, 20));
    if (d.once_in(4)) {
        size = glm::vec3(d.magnitude(-20, 0)) * glm::abs(low);
    }
    const glm::vec3 high = low + size;
    glm::vec3 share(d.unit(), d.unit(), d.unit());
    if (d.once_in(8)) {
        share = share * 3.0f - 1.0f;
    }
    d.put(low + share * (high - low));
    d.put(low);
    d.put(high);
}

std::vector<Function> elementary_functions() {
    return {
        {"sincos_2pi", of_sincos_2pi, "turns: [0, 1) and 2^-60 … 1, both signs",
         [](Draw& d) { d.put(d.sign() * (d.once_in(4) ? d.magnitude(-60, 0) : d.unit())); }, 1,
         "11", ulp, 4},
        {"log_complement", of_log_complement, "[0, 1) and 2^-100 … 1/2",
         [](Draw& d) { d.put(d.once_in(2) ? d.magnitude(-100, -1) : d.unit()); }, 1, "1", ulp, 4},
        {"exp_negative", of_exp_negative, "-2^7 … -2^-100",
         [](Draw& d) { d.put(-d.magnitude(d.once_in(2) ? -100 : -3, 7)); }, 1, "1", ulp, 2},
        {"exp_complement", of_exp_complement, "-2^7 … -2^-100",
         [](Draw& d) { d.put(-d.magnitude(d.once_in(2) ? -100 : -3, 7)); }, 1, "1", ulp, 3},
        {"pow_real", of_pow_real,
         "2^-126 … 2^127 to powers with results 10^-37 … 10^38, powers of two among them",
         [](Draw& d) {
             const float x = d.once_in(3) ? d.magnitude(-1, 1) : d.magnitude(-126, 127);
             d.put(x);
             d.put(d.once_in(8) || x == 1
                       ? 0.5f
                       : static_cast<float>(d.between(-85, 88) / std::log(double(x))));
         },
         2, "1", ulp, 2},
    };
}

std::vector<Function> vectors_and_frames() {
    return {
        {"unit_and_length", of_unit_and_length, "components 2^-100 … 2^100, mixed, zeros",
         [](Draw& d) {
             const int middle = static_cast<int>(d.bits() % 180) - 90;
             d.put(d.nonzero_vector(middle - 10, middle + 10));
         },
         3, "31", ulp, 4},
        {"dot3", of_dot3, "components 2^-40 … 2^40, mixed, and nearly at right angles",
         [](Draw& d) {
             const glm::vec3 n = d.direction();
             d.put(n);
             d.put(d.once_in(2) ? rounded(d.across(n)) : d.vector(-40, 40));
         },
         6, "1", conditioned, 2},
        {"cross3", of_cross3, "components 2^-40 … 2^40, mixed, and nearly parallel",
         [](Draw& d) {
             const glm::vec3 v = d.vector(-40, 40);
             d.put(v);
             d.put(d.once_in(2) ? v * 3.0f : d.vector(-40, 40));
         },
         6, "3", conditioned, 1.5},
        {"luminance, mean_component", of_luminance, "colours 2^-60 … 2^60, zeros",
         [](Draw& d) { d.put(glm::abs(d.vector(-60, 60))); }, 3, "11", ulp, 4},
        {"make_frame", of_make_frame, "directions, near ±z among them",
         [](Draw& d) { d.put(d.direction()); }, 3, "33", ulp, 4},
        {"to_world", of_to_world, "directions, vectors 2^-20 … 2^20",
         [](Draw& d) {
             d.put(d.direction());
             d.put(d.vector(-20, 20));
         },
         6, "3", ulp, 4},
        {"to_local", of_to_local, "directions, vectors 2^-20 … 2^20",
         [](Draw& d) {
             d.put(d.direction());
             d.put(d.vector(-20, 20));
         },
         6, "3", ulp, 4},
    };
}

std::vector<Function> samplers() {
    return {
        {"sample_disc", of_sample_disc, "[0, 1)², corners and centre",
         [](Draw& d) {
             d.put(d.unit());
             d.put(d.unit());
         },
         2, "2", ulp, 5},
        {"disc_radius", of_disc_radius, "[0, 1)², corners and centre",
         [](Draw& d) {
             d.put(d.unit());
             d.put(d.unit());
         },
         2, "11", ulp, 3},
        {"sample_cosine_hemisphere", of_sample_cosine_hemisphere, "[0, 1)², corners and centre",
         [](Draw& d) {
             d.put(d.unit());
             d.put(d.unit());
         },
         2, "311", ulp, 5},
        {"sample_sphere", of_sample_sphere, "[0, 1)², corners and centre",
         [](Draw& d) {
             d.put(d.unit());
             d.put(d.unit());
         },
         2, "3", ulp, 3},
        {"sample_triangle", of_sample_triangle, "[0, 1)², corners and centre",
         [](Draw& d) {
             d.put(d.unit());
             d.put(d.unit());
         },
         2, "11", ulp, 3},
    };
}

std::vector<Function> codes_and_random_numbers() {
    return {
        {"pack_unit", of_pack_unit, "directions", [](Draw& d) { d.put(d.direction()); }, 3, "cc",
         ulp, 0},
        {"unpack_unit", of_unpack_unit, "two codes 1 … 65,535",
         [](Draw& d) {
             for (int i = 0; i < 2; ++i) {
                 const float ends[] = {1, 32768, 65535};
                 d.put(d.once_in(6) ? ends[d.bits() % 3]
                                    : static_cast<float>(1 + d.bits() % 65535));
             }
         },
         0, "3", ulp, 5},
        {"morton_cell, 10 bits", of_morton_cell,
         "points in boxes and outside, boxes of 2^-20 of their distance from the origin and flat "
         "ones",
         put_point_and_box, 9, "d", ulp, 0},
        {"morton_cell, 21 bits", of_fine_morton_cell,
         "points in boxes and outside, boxes of 2^-20 of their distance from the origin and flat "
         "ones",
         put_point_and_box, 9, "d", ulp, 0, 0.06},
        {"random4", of_random4, "any words",
         [](Draw& d) {
             put_words(d, 3);
             d.put(static_cast<float>(d.bits() % 64));
         },
         0, "dddd", ulp, 0},
        {"sobol_random4", of_sobol_random4, "any words",
         [](Draw& d) {
             put_words(d, 3);
             d.put(static_cast<float>(d.bits() % 4));
         },
         0, "dddd", ulp, 0},
        {"fixed_add", of_fixed_add, "any words", [](Draw& d) { put_words(d, 4); }, 0, "dddd", ulp,
         0},
    };
}

std::vector<Function> query_cells_and_photons() {
    return {
        {"query_cell", of_query_cell, "points 2^-10 … 2^4 on surfaces facing ±z, cells 2^-14 … 2",
         [](Draw& d) {
             const float largest = d.magnitude(-6, 0);
             // On the octahedron's edge, rounding decides on which side a normal's frame is; avoid
             // it.
             d.put(rounded(
                 glm::normalize(glm::dvec3(d.direction()) + glm::dvec3(0, 0, 2 * d.sign()))));
             d.put(largest);
             d.put(largest * d.magnitude(-8, 1));
             d.put(d.vector(-10, 4)); // its bits are hashed
         },
         5, "cccd", ulp, 0},
        {"direction_cell, direction_steps", of_direction_cell,
         "directions, GGX alpha 10^-3 … 1, shares 0 … 1",
         [](Draw& d) {
             d.put(d.direction());
             d.put(d.magnitude(-10, 0));
             d.put(d.share());
             put_words(d, 1);
         },
         5, "ddd", ulp, 0},
        {"pack_photon_normal", of_pack_photon_normal, "directions",
         [](Draw& d) {
             d.put(d.direction());
             d.put(static_cast<float>(d.bits() % 2));
         },
         3, "ccd", ulp, 0},
        {"unpack_photon_normal", of_unpack_photon_normal, "codes", [](Draw& d) { put_words(d, 1); },
         0, "3", ulp, 5},
        {"kernel_weight", of_kernel_weight, "squared distances 2^-40 … 2",
         [](Draw& d) { d.put(d.once_in(2) ? d.share() : d.magnitude(-40, 1)); }, 1, "1", ulp, 1},
        {"flux_units", of_flux_units, "fluxes of 0 … 2^22 units of 2^-100 … 2^100",
         [](Draw& d) {
             const float unit = d.magnitude(-100, 100);
             d.put(unit * (d.once_in(8) ? 0 : d.magnitude(-2, 22)));
             d.put(unit);
         },
         2, "d", ulp, 0},
    };
}

} // namespace

std::vector<Function> maths_table() {
    return joined({elementary_functions(), vectors_and_frames(), samplers(),
                   codes_and_random_numbers(), query_cells_and_photons()});
}

} // namespace argand::testing
