#include "table.hpp"

#include "light_functions.h"

namespace argand::testing {

namespace {

constexpr auto ulp = Measure::ulp;
constexpr auto conditioned = Measure::conditioned;

constexpr float point = light_point, spot = light_spot, triangle = light_triangle;

/// Cosines of a spot's cones, including narrow ones of 10^-3 rad and a hemisphere.
glm::vec2 spot_cosines(Draw& d) {
    const double outer = d.once_in(3) ? double(d.magnitude(-10, 0)) : d.between(0.1, 1.57);
    const double inner = d.once_in(4) ? 0 : outer * d.between(0, 1);
    return {static_cast<float>(std::cos(inner)), static_cast<float>(std::cos(outer))};
}

/// Fourteen numbers: position, colour, cones and direction, or a triangle.
void put_light(Draw& d, float kind) {
    const glm::vec3 place = d.vector(-10, 10);
    const glm::vec2 cosines = spot_cosines(d);
    const glm::vec3 second =
        kind == triangle ? place + d.direction() * d.magnitude(-10, 10) : d.direction();
    const glm::vec3 third = place + d.direction() * d.magnitude(-10, 10);
    d.put(place);
    d.put(glm::abs(d.vector(-60, 60)));
    d.put(cosines.x);
    d.put(second);
    d.put(cosines.y);
    d.put(third);
}

float any_kind(Draw& d) { return static_cast<float>(d.bits() % 5); }

glm::vec3 position_of_light(const Draw& d, std::size_t first) {
    return {d.x[first], d.x[first + 1], d.x[first + 2]};
}

/// Two vectors of any size, including nearly parallel ones.
void put_pair(Draw& d, int low, int high) {
    const glm::vec3 u = d.nonzero_vector(low, high);
    d.put(u);
    const bool skewed = d.once_in(4);
    d.put(skewed ? u * 0.7f + d.nonzero_vector(low, high) * 1e-4f : d.nonzero_vector(low, high));
}

/// Change of a unit normal, perpendicular to it.
void put_normal_change(Draw& d, glm::vec3 n) {
    d.put(d.once_in(4) ? glm::vec3(0)
                       : rounded(d.across(glm::dvec3(n)) * double(d.magnitude(-12, 10))));
}

/// An incoming direction, the normal at its hit, and the normal's changes with both parameters.
void put_curved_hit(Draw& d) {
    const glm::vec3 n = d.direction();
    d.put(-d.above(n));
    d.put(n);
    put_normal_change(d, n);
    put_normal_change(d, n);
}

void put_differential(Draw& d) {
    const int size = static_cast<int>(d.bits() % 40) - 20;
    put_pair(d, size - 3, size);
    put_pair(d, -12, 0);
}

/// Two axes perpendicular to n, with lengths in a ratio of up to 1000, and a third along n.
void put_footprint(Draw& d, glm::vec3 n) {
    const glm::dvec3 z(n);
    const glm::dvec3 u = d.across(z);
    const glm::dvec3 v = d.once_in(4) ? u + glm::cross(z, u) * 1e-3 : d.across(z);
    const double size = d.magnitude(-20, 20);
    d.put(rounded(u * size));
    d.put(rounded(v * size * double(d.magnitude(-10, 0))));
    d.put(rounded(z * size * 0.1));
}

void put_duals(Draw& d, glm::vec3 n) {
    const glm::dvec3 z(n);
    const glm::dvec3 a = d.across(z);
    const glm::dvec3 b = d.once_in(4) ? a + glm::cross(z, a) * 1e-3 : d.across(z);
    const double size = d.magnitude(-20, 20);
    d.put(rounded(a * size));
    d.put(rounded(b * size * double(d.magnitude(0, 10))));
}

std::vector<Function> spots_and_power() {
    return {
        {"spot_falloff", of_spot_falloff, "cosines across the ramp, cones 10^-3 … 1.57 rad",
         [](Draw& d) {
             const glm::vec2 c = spot_cosines(d);
             d.put(static_cast<float>(d.once_in(4) ? d.between(-1, 1) : d.between(c.y, c.x)));
             d.put(c.x);
             d.put(c.y);
         },
         3, "1", conditioned, 2},
        {"spot_ramp", of_spot_ramp, "cones 10^-3 … 1.57 rad",
         [](Draw& d) {
             const glm::vec2 c = spot_cosines(d);
             d.put(c.x);
             d.put(c.y);
         },
         2, "1", ulp, 1},
        {"sample_spot", of_sample_spot,
         "cones 10^-3 … 1.57 rad around any axis, corners of [0, 1)^6",
         [](Draw& d) {
             for (int i = 0; i < 6; ++i) {
                 d.put(d.unit());
             }
             put_light(d, spot);
         },
         20, "3", conditioned, 4},
        {"spot_solid_angles", of_spot_solid_angles, "cones 10^-3 … 1.57 rad",
         [](Draw& d) {
             const glm::vec2 c = spot_cosines(d);
             d.put(c.x);
             d.put(c.y);
         },
         2, "11", conditioned, 6},
        {"light_normal (and area)", of_light_normal, "triangles of edges 2^-10 … 2^10 at 0 … 2^10",
         [](Draw& d) { put_light(d, triangle); }, 14, "31", conditioned, 6},
        {"light_power", of_light_power, "all kinds, radii 2^-20 … 2^20, colours 2^-60 … 2^60",
         [](Draw& d) {
             const float kind = any_kind(d);
             d.put(d.magnitude(-20, 20));
             put_light(d, kind);
             d.put(kind);
             d.put(static_cast<float>(d.bits() % 2));
         },
         15, "3", conditioned, 4},
        {"emitter_density", of_emitter_density,
         "probabilities 2^-20 … 1, areas and distances 2^-20 … 2^20, cosines 2^-20 … 1",
         [](Draw& d) {
             d.put(d.magnitude(-20, 0));
             d.put(d.magnitude(-20, 20));
             d.put(d.magnitude(-20, 20));
             d.put(d.magnitude(-20, 0));
         },
         4, "1", ulp, 8},
        {"descend_aim", of_descend_aim, "corners of [0, 1)^4, cuts and shares 1/32 … 31/32",
         [](Draw& d) {
             for (int i = 0; i < 4; ++i) {
                 d.put(d.unit());
             }
             d.put(static_cast<float>(1 + d.bits() % 31) / 32);
             d.put(static_cast<float>(1 + d.bits() % 31) / 32);
         },
         6, "111", conditioned, 8},
    };
}

std::vector<Function> light_samples_and_photons() {
    return {
        {"light_sample", of_light_sample,
         "all kinds, points 2^-10 … 2^10, corners of [0, 1)²; emitters edge-on down to a cosine of "
         "10^-6 (of absolute error)",
         [](Draw& d) {
             const float kind = any_kind(d);
             d.put(d.vector(-10, 10));
             d.put(d.unit());
             d.put(d.unit());
             put_light(d, kind);
             d.put(kind);
             d.put(static_cast<float>(d.bits() % 2));
             if (kind == spot) { // in its cone
                 const glm::vec3 p = position_of_light(d, 5) +
                                     d.magnitude(-5, 5) * glm::vec3(d.x[12], d.x[13], d.x[14]);
                 d.next = 0;
                 d.put(p);
             }
         },
         19, "d331", conditioned, 1500},
        {"light_emit", of_light_emit, "all kinds, corners of [0, 1)^6, scene radii 2^-10 … 2^10",
         [](Draw& d) {
             const float kind = any_kind(d);
             for (int i = 0; i < 6; ++i) {
                 d.put(d.unit());
             }
             d.put(d.magnitude(-10, 10));
             d.put(0);
             put_light(d, kind);
             d.put(kind);
             d.put(static_cast<float>(d.bits() % 2));
         },
         22, "d333", conditioned, 4},
        {"light_emit_aimed", of_light_emit_aimed,
         "as light_emit, spheres of 1/16 … 1/4 of the scene; the photon's place",
         [](Draw& d) {
             const float kind = any_kind(d);
             for (int i = 0; i < 6; ++i) {
                 d.put(d.unit());
             }
             d.put(d.magnitude(-10, 10));
             d.put(0.125f + 0.25f * static_cast<float>(d.bits() % 4)); // a sphere, or none
             put_light(d, kind);
             d.put(kind);
             d.put(static_cast<float>(d.bits() % 2));
         },
         22, "d33", conditioned, 8},
        {"triangle_piece", of_triangle_piece, "1 … 4^11",
         [](Draw& d) {
             float number = 1;
             for (auto levels = d.bits() % 12; levels > 0; --levels) {
                 number = 4 * number + static_cast<float>(d.bits() % 4);
             }
             d.put(number);
         },
         1, "222", ulp, 0},
    };
}

std::vector<Function> spreads() {
    return {
        {"photon_spacing", of_photon_spacing, "photons 0 … 2^30, densities 0 … 2^40",
         [](Draw& d) {
             d.put(d.once_in(8) ? 0 : d.magnitude(-1, 30));
             d.put(d.once_in(8) ? 0 : d.magnitude(-40, 40));
         },
         2, "1", ulp, 3},
        {"direction_axes", of_direction_axes, "directions around any axis, near the poles by 2^-26",
         [](Draw& d) {
             const glm::vec3 axis = d.direction();
             d.put(axis);
             const glm::dvec3 z(axis);
             d.put(d.once_in(2)
                       ? d.direction()
                       : rounded(glm::normalize(z + d.across(z) * double(d.magnitude(-20, 0)))));
         },
         6, "33", conditioned, 6},
        {"parallelogram_side", of_parallelogram_side, "vectors 2^-60 … 2^60, nearly parallel ones",
         [](Draw& d) { put_pair(d, -60, 60); }, 6, "1", conditioned, 5},
        {"transferred_offset", of_transferred_offset,
         "any differential, distances 2^-10 … 2^10, grazing by 10^-7",
         [](Draw& d) {
             const glm::vec3 n = d.direction();
             d.put(d.nonzero_vector(-20, 0));
             d.put(d.nonzero_vector(-12, 0));
             d.put(d.above(n) * d.sign());
             d.put(d.magnitude(-10, 10));
             d.put(n);
         },
         13, "3", conditioned, 32},
        {"reflected_spread", of_reflected_spread,
         "any differential, curvatures 0 … 2^10, grazing by 10^-7",
         [](Draw& d) {
             const glm::vec3 n = d.direction();
             d.put(d.nonzero_vector(-12, 0));
             d.put(-d.above(n));
             d.put(n);
             put_normal_change(d, n);
         },
         12, "3", conditioned, 5},
        {"refracted_spread", of_refracted_spread,
         "as reflected_spread; ratios 0.1 … 10, 1 ± 10^-7, total reflection",
         [](Draw& d) {
             const glm::vec3 n = d.direction();
             d.put(d.nonzero_vector(-12, 0));
             d.put(-d.above(n));
             d.put(n);
             put_normal_change(d, n);
             d.put(d.index_ratio());
         },
         13, "3", conditioned, 8},
    };
}

std::vector<Function> differentials() {
    return {
        {"transfer_differential", of_transfer_differential,
         "any differential, distances 2^-10 … 2^10, grazing by 10^-7",
         [](Draw& d) {
             const glm::vec3 n = d.direction();
             d.put(d.above(n) * d.sign());
             d.put(d.magnitude(-10, 10));
             d.put(n);
             put_differential(d);
         },
         19, "3333", conditioned, 32},
        {"reflect_differential", of_reflect_differential,
         "any differential, curvatures 0 … 2^10, grazing by 10^-7",
         [](Draw& d) {
             put_curved_hit(d);
             put_differential(d);
         },
         24, "3333", conditioned, 8},
        {"refract_differential", of_refract_differential,
         "as reflect_differential; ratios 0.1 … 10, 1 ± 10^-7, total reflection",
         [](Draw& d) {
             put_curved_hit(d);
             d.put(d.index_ratio());
             put_differential(d);
         },
         25, "3333", conditioned, 8},
        {"roulette_differential", of_roulette_differential, "probabilities 0 … 1, any differential",
         [](Draw& d) {
             d.put(d.share());
             put_differential(d);
         },
         13, "3333", ulp, 5},
        {"add_independent_spread", of_independent_spread, "spreads 2^-20 … 2^5, any differential",
         [](Draw& d) {
             d.put(d.direction());
             d.put(d.magnitude(-20, 5));
             put_differential(d);
         },
         16, "3333", conditioned, 4},
        {"reemitted_differential", of_reemitted_differential,
         "all three kinds, photons 1 … 2^30, grazing by 10^-7",
         [](Draw& d) {
             const glm::vec3 n = d.direction();
             d.put(n);
             d.put(d.above(n));
             d.put(d.magnitude(0, 30));
             put_differential(d);
             d.put(static_cast<float>(d.bits() % 3));
         },
         19, "3333", conditioned, 6},
        {"gloss_differential", of_gloss_differential,
         "photons 1 … 2^30, densities 2^-40 … 2^40, grazing by 10^-7",
         [](Draw& d) {
             const glm::vec3 n = d.direction();
             d.put(-d.above(n));
             d.put(d.above(n));
             d.put(n);
             put_normal_change(d, n);
             d.put(d.magnitude(0, 30));
             d.put(d.magnitude(-40, 40));
             put_differential(d);
         },
         26, "3333", conditioned, 8},
    };
}

std::vector<Function> differentials_of_lights_and_normals() {
    return {
        {"shading_normal_change", of_shading_normal_change,
         "triangles 2^-10 … 2^10, normals up to 30° apart",
         [](Draw& d) {
             const glm::dvec3 n(d.direction());
             const double size = d.magnitude(-10, 10);
             const glm::dvec3 v0 = glm::dvec3(d.direction()) * size;
             d.put(rounded(v0));
             d.put(rounded(v0 + d.across(n) * size));
             d.put(rounded(v0 + d.across(n) * size));
             for (int i = 0; i < 3; ++i) {
                 d.put(rounded(glm::normalize(n + 0.25 * glm::dvec3(d.direction()))));
             }
             d.put(static_cast<float>(d.between(0, 0.5)));
             d.put(static_cast<float>(d.between(0, 0.5)));
             d.put(rounded(d.across(n) * size * double(d.magnitude(-10, 0))));
         },
         23, "3", conditioned, 6},
        {"light_differential", of_light_differential, "all kinds, photons 1 … 2^30",
         [](Draw& d) {
             const float kind = any_kind(d);
             const glm::vec3 n = d.direction();
             d.put(d.above(n));
             d.put(n);
             d.put(d.magnitude(-10, 10));
             d.put(d.magnitude(0, 30));
             put_light(d, kind);
             d.put(kind);
             d.put(static_cast<float>(d.bits() % 2));
             if (kind ==
                 // The spot's axis is near the photon's direction, so that it is inside the cone.
                 spot) {
                 const glm::dvec3 z(d.x[0], d.x[1], d.x[2]);
                 const glm::vec3 axis =
                     rounded(glm::normalize(z + d.across(z) * double(d.magnitude(-12, 0))));
                 d.next = 15;
                 d.put(axis);
             }
         },
         22, "3333", conditioned, 6},
    };
}

std::vector<Function> footprints() {
    return {
        {"make_footprint_scale", of_footprint_scale, "photons 1 … 2^30, scene sizes 2^-40 … 2^40",
         [](Draw& d) {
             d.put(d.magnitude(0, 30));
             d.put(d.magnitude(-40, 40));
         },
         2, "1111", ulp, 16},
        {"make_principal", of_make_principal, "axes 2^-20 … 2^20, nearly parallel, nearly circles",
         [](Draw& d) {
             const int size = static_cast<int>(d.bits() % 40) - 20;
             put_pair(d, size - 3, size);
         },
         6, "6", conditioned, 3},
        {"make_footprint (extent and area)", of_make_footprint,
         "differentials 2^-40 … 2^40 of aspect up to 10^6 (the short axis is as exact as the long "
         "one), photons 1 … 2^30, "
         "scene sizes 2^-20 … 2^20",
         [](Draw& d) {
             const glm::vec3 n = d.direction();
             const glm::dvec3 z(n);
             const double size = d.magnitude(-40, 40);
             const glm::dvec3 u = d.across(z) * size;
             d.put(rounded(u));
             d.put(rounded(d.across(z) * size * double(d.magnitude(-10, 0))));
             d.put(n);
             d.put(d.magnitude(0, 30));
             d.put(d.magnitude(-20, 20));
             d.put(static_cast<float>(d.bits() % 2));
             d.put(static_cast<float>(d.bits() % 2));
         },
         11, "31", conditioned, 8000},
        {"splat_differential, splat_scale (extent)", of_splat,
         "directions down to 10^-3 over the surface, distances and sizes 2^-20 … 2^20",
         [](Draw& d) {
             const glm::vec3 n = d.direction();
             const glm::dvec3 z(n);
             d.put(rounded(glm::normalize(d.across(z) - z * double(d.magnitude(-10, 10)))));
             d.put(n);
             d.put(d.magnitude(-20, 20));
             d.put(d.magnitude(-20, 20));
             d.put(d.magnitude(-20, 20));
             d.put(d.magnitude(-20, 20));
             d.put(static_cast<float>(d.bits() % 2));
         },
         11, "3", conditioned, 8},
        {"footprint_area", of_footprint_area, "semi-axes 2^-30 … 2^20, skewed to 10^-3",
         [](Draw& d) { put_footprint(d, d.direction()); }, 9, "1", conditioned, 8},
        {"footprint_duals", of_footprint_duals, "semi-axes 2^-30 … 2^20, skewed to 10^-3",
         [](Draw& d) {
             const glm::vec3 n = d.direction();
             put_footprint(d, n);
             d.put(n);
         },
         12, "33", conditioned, 6},
        {"footprint_of_duals", of_footprint_of_duals, "dual axes 2^-20 … 2^30, skewed to 10^-3",
         [](Draw& d) {
             const glm::vec3 n = d.direction();
             put_duals(d, n);
             d.put(n);
             d.put(d.magnitude(-4, 0));
         },
         10, "333", conditioned, 8},
        {"footprint_extent", of_footprint_extent, "semi-axes 2^-30 … 2^20, skewed to 10^-3",
         [](Draw& d) { put_footprint(d, d.direction()); }, 9, "3", ulp, 4},
        {"footprint_weight", of_footprint_weight,
         "dual axes 2^-20 … 2^30, queries inside and outside, planes up to 60° off",
         [](Draw& d) {
             const glm::vec3 n = d.direction();
             put_duals(d, n);
             d.put(n);
             const glm::dvec3 z(n);
             d.put(rounded(glm::normalize(z + d.across(z) * d.between(0, 1.7))));
             const double reach =
                 1.5 / std::max({std::abs(d.x[0]), std::abs(d.x[1]), std::abs(d.x[2]), 1e-30f});
             d.put(rounded(d.across(z) * reach * d.between(0, 1) +
                           z * reach * double(d.magnitude(-10, -3))));
             d.put(d.magnitude(-4, 0));
         },
         16, "1", conditioned, 3},
    };
}

std::vector<Function> packed_footprints() {
    return {
        {"pack_dual", of_pack_dual, "vectors 2^-90 … 2^90, zeros",
         [](Draw& d) {
             const int size = static_cast<int>(d.bits() % 180) - 90;
             d.put(d.vector(size - 8, size));
         },
         3, "ccdc", ulp, 0},
        {"unpack_dual", of_unpack_dual, "three codes 1 … 65,535, exponents -99 … 100",
         [](Draw& d) {
             const auto code = [&] {
                 const std::uint32_t ends[] = {1, 32768, 65535};
                 return d.once_in(6) ? ends[d.bits() % 3]
                                     : static_cast<std::uint32_t>(1 + d.bits() % 65535);
             };
             const std::uint32_t x = code();
             const std::uint32_t y = code();
             d.put_word(x | (y << 16));
             d.put_word(code() | (static_cast<std::uint32_t>(28 + d.bits() % 200) << 23));
         },
         0, "3", ulp, 1.5},
        {"unpack_dual of pack_dual: the vector", of_dual_read, "vectors 2^-90 … 2^90, zeros",
         [](Draw& d) {
             const int size = static_cast<int>(d.bits() % 180) - 90;
             d.put(d.vector(size - 8, size));
         },
         3, "3", ulp, 900}, // 2^-15 of the largest component in each
        {"load_differential of differential_record: the differential", of_differential_record,
         "any differential", put_differential, 12, "dddddddddddd", ulp, 0},
    };
}

} // namespace

std::vector<Function> light_table() {
    return joined({spots_and_power(), light_samples_and_photons(), spreads(), differentials(),
                   differentials_of_lights_and_normals(), footprints(), packed_footprints()});
}

} // namespace argand::testing
