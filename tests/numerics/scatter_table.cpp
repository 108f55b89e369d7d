#include "table.hpp"

#include "scatter_functions.h"

namespace argand::testing {

namespace {

constexpr auto ulp = Measure::ulp;
constexpr auto conditioned = Measure::conditioned;

/// Any glTF material or modified Phong, including roughness 0, 10^-4 and 1, and indices 0, 1, 1 +
/// 10^-7 and 10.
void put_material(Draw& d) {
    const bool phong = d.once_in(6);
    const auto end_or_share = [&] {
        return d.once_in(3) ? static_cast<float>(d.bits() % 2) : d.unit();
    };
    const float split = phong ? 0.5f : 1.0f;
    d.put({split * end_or_share(), split * end_or_share(), split * end_or_share()});
    d.put(phong ? 0 : end_or_share()); // metallic
    const float most = phong ? 0.5f : 1.9f;
    d.put({most * end_or_share(), most * end_or_share(), most * end_or_share()});
    d.put(end_or_share()); // specular
    const float exponent = std::exp2(static_cast<float>(d.between(0, 20)));
    const float roughnesses[] = {0, 1e-4f, 0.03f, 1};
    d.put(d.once_in(2) ? roughnesses[d.bits() % 4] : d.unit());
    d.put(phong ? 0 : end_or_share()); // transmission
    const float indices[] = {0, 1, 1 + 0x1p-23f, 1.5f, 10};
    d.put(d.once_in(2) ? indices[d.bits() % 5] : static_cast<float>(d.between(1, 3)));
    d.put(static_cast<float>(d.bits() % 2)); // thickness
    d.put(d.once_in(2) ? 1 : d.unit());      // coverage
    d.put(phong ? exponent : -1);
}

/// Two directions, of which the second is often near the first one's mirrored one.
void put_directions(Draw& d) {
    const glm::vec3 wo = d.upper();
    glm::dvec3 wi(-wo.x, -wo.y, wo.z);
    wi += d.across(wi) * double(d.magnitude(-20, 0));
    wi.z = std::abs(wi.z);
    d.put(wo);
    d.put(d.once_in(2) ? d.upper() : rounded(glm::normalize(wi)));
}

/// Directions and a material.
void put_scattering(Draw& d) {
    put_directions(d);
    put_material(d);
}

/// Also the requested lobes; includes directions from below.
void put_scattering_by_lobes(Draw& d) {
    put_scattering(d);
    const std::uint32_t lobes[] = {LOBES_ALL,   LOBES_ALL,   LOBE_DIFFUSE,
                                   LOBE_GLOSSY, LOBES_DELTA, LOBE_DIFFUSE | LOBE_GLOSSY};
    d.put(static_cast<float>(lobes[d.bits() % 6]));
    if (d.once_in(12)) {
        const std::size_t z = d.once_in(2) ? 2 : 5;
        d.x[z] = -d.x[z];
    }
}

void put_wo_and_u(Draw& d) {
    d.put(d.upper());
    d.put(d.unit());
    d.put(d.unit());
}

struct Triangle {
    glm::vec3 v0, v1, v2;
    bool sliver = false;
};

/// A triangle; includes slivers of aspect 10^6 and places 10^5 sizes from the origin.
Triangle any_triangle(Draw& d, bool sliver) {
    const double size = d.magnitude(-10, 10);
    const bool far = !sliver && d.once_in(4);
    const double away = far ? 1e5 * size : size;
    const glm::dvec3 place = (glm::dvec3(d.direction()) + glm::dvec3(0.37, 0.21, -0.33)) * away;
    const glm::dvec3 n(d.direction());
    const glm::dvec3 e1 = d.across(n) * size;
    const glm::dvec3 e2 = glm::cross(n, e1);
    return {rounded(place), rounded(place + e1),
            rounded(place + e1 * d.between(0.2, 0.8) + e2 * (sliver ? 1e-6 : 1.0)), sliver};
}

void put(Draw& d, const Triangle& t) {
    d.put(t.v0);
    d.put(t.v1);
    d.put(t.v2);
}

/// Barycentric weights inside, on an edge or at a vertex.
glm::dvec2 any_weights(Draw& d) {
    double u = d.between(0, 1);
    double v = d.between(0, 1);
    if (u + v > 1) {
        u = 1 - u;
        v = 1 - v;
    }
    switch (d.bits() % 8) {
    case 0:
        return {0, v};
    case 1:
        return {u, 1 - u};
    case 2:
        return {0, 0};
    case 3:
        return {1, 0};
    default:
        return {u, v};
    }
}

glm::dvec3 at(const Triangle& t, glm::dvec2 b) {
    return glm::dvec3(t.v0) * (1 - b.x - b.y) + glm::dvec3(t.v1) * b.x + glm::dvec3(t.v2) * b.y;
}

/// A ray towards a point in, on the edge of, or beside a triangle; includes rays along axes and
/// rays that graze by 10^-7.
void put_ray_and_triangle(Draw& d, bool sliver) {
    const Triangle t = any_triangle(d, sliver);
    // At a sliver's tips even double precision cannot decide.
    const glm::dvec2 weights =
        t.sliver ? glm::dvec2(d.between(0.2, 0.4), d.between(0.2, 0.4)) : any_weights(d);
    const glm::dvec3 target = at(t, weights) + (d.once_in(4) ? glm::dvec3(d.direction()) *
                                                                   double(glm::length(t.v1 - t.v0))
                                                             : glm::dvec3(0));
    const double away = double(glm::length(t.v1 - t.v0)) * d.magnitude(-3, t.sliver ? 0 : 6);
    const glm::vec3 n = glm::normalize(glm::cross(t.v1 - t.v0, t.v2 - t.v0));
    const bool has_normal = glm::length(n) > 0.5f;
    glm::vec3 direction = d.direction();
    const bool on_border = weights.x == 0 || weights.y == 0 || weights.x + weights.y == 1;
    if (has_normal && on_border) {
        // Seen edge-on, the band around the edge is as thin as a sliver.
        direction = glm::dot(direction, n) < 0 ? direction - n : direction + n;
        direction =
            glm::length(direction) > 0.5f ? rounded(glm::normalize(glm::dvec3(direction))) : n;
    } else if (has_normal && d.once_in(4)) {
        direction = d.above(n);
    }
    d.put(rounded(target - glm::dvec3(direction) * away));
    d.put(direction);
    put(d, t);
}

void put_camera(Draw& d, bool orthographic) {
    d.put(static_cast<float>(d.between(0, 4096)));
    d.put(static_cast<float>(d.between(0, 4096)));
    const glm::dvec3 forward(d.direction());
    const glm::dvec3 right = d.across(forward);
    const glm::dvec3 down = glm::cross(forward, right);
    const double step = d.magnitude(-4, 1) / 4096 * (orthographic ? d.magnitude(-20, 20) : 1.0);
    d.put(d.vector(-20, 20));
    const glm::dvec3 corner = forward - (right + down) * (step * 2048);
    d.put(rounded(orthographic ? forward : corner));
    d.put(rounded(right * step));
    d.put(rounded(down * step));
    d.put(orthographic ? 1 : 0);
}

std::vector<Function> microfacets() {
    return {
        {"fresnel_dielectric", of_fresnel_dielectric,
         "cosines 0 … 1, at the critical angle; ratios 0.1 … 10, 1 ± 10^-7",
         [](Draw& d) {
             const float eta = d.index_ratio();
             const double critical = std::sqrt(std::max(1 - double(eta) * double(eta), 0.0));
             d.put(d.once_in(4)
                       ? static_cast<float>(critical) * (1 + d.sign() * d.magnitude(-24, -10))
                       : d.share());
             d.put(eta);
         },
         2, "d11", conditioned, 12, 0.045},
        {"fresnel_schlick", of_fresnel_schlick,
         "reflectances and cosines 0 … 1, at grazing the highest",
         [](Draw& d) {
             const float f90 = d.share();
             d.put(f90 * glm::vec3(d.share(), d.share(), d.share()));
             d.put(f90);
             d.put(d.share());
         },
         5, "3", ulp, 6},
        {"ggx_distribution", of_ggx_distribution,
         "alpha 10^-3 … 1, half vectors near and far from the peak",
         [](Draw& d) {
             d.put(d.magnitude(-10, 0));
             d.put(d.upper() * static_cast<float>(d.between(0.001, 2)));
         },
         4, "1", ulp, 16},
        {"ggx_visibility", of_ggx_visibility, "alpha 10^-3 … 1, cosines 2^-30 … 1",
         [](Draw& d) {
             d.put(d.magnitude(-10, 0));
             d.put(d.magnitude(d.once_in(2) ? -30 : -2, 0));
             d.put(d.magnitude(d.once_in(2) ? -30 : -2, 0));
         },
         3, "1", ulp, 6},
        {"ggx_sample_normal", of_ggx_sample_normal,
         "alpha 10^-3 … 1, grazing and upright, corners of [0, 1)²",
         [](Draw& d) {
             d.put(d.magnitude(-10, 0));
             put_wo_and_u(d);
         },
         6, "3", conditioned, 10},
        {"ggx_reflection_pdf", of_ggx_reflection_pdf,
         "alpha 10^-3 … 1, distributions 2^-30 … 2^20, cosines 2^-30 … 1",
         [](Draw& d) {
             d.put(d.magnitude(-10, 0));
             d.put(d.magnitude(-30, 20));
             d.put(d.magnitude(-30, 0));
         },
         3, "1", ulp, 5},
        // Upright facets seen at grazing angles are a difference of nearly equal numbers.
        {"brushed_sample_normal, brushed_facets", of_brushed,
         "alphas 10^-3 … 1, any direction of spread, upright and grazing, near the mirror's "
         "direction and far",
         [](Draw& d) {
             put_directions(d);
             d.put(d.unit());
             d.put(d.unit());
             d.put(d.magnitude(-10, 0));
             d.put(d.magnitude(-10, 0));
             const glm::vec2 along(d.direction());
             const bool aligned = along == glm::vec2(0) || d.once_in(3);
             d.put(aligned ? 1 : along.x);
             d.put(aligned ? 0 : along.y);
         },
         12, "311", conditioned, 200},
    };
}

std::vector<Function> phong_lobes() {
    return {
        {"phong_power", of_phong_power, "exponents 0 … 2^21, directions near the mirror's and far",
         [](Draw& d) {
             const glm::vec3 wo = d.upper();
             const glm::dvec3 mirror(-wo.x, -wo.y, wo.z);
             d.put(d.once_in(8) ? 0 : d.magnitude(-4, 21));
             d.put(wo);
             d.put(d.once_in(2) ? d.upper()
                                : rounded(glm::normalize(
                                      mirror + d.across(mirror) * double(d.magnitude(-12, 0)))));
         },
         7, "1", conditioned, 3},
        {"phong_sample", of_phong_sample,
         "exponents 0 … 2^21, grazing and upright, corners of [0, 1)²",
         [](Draw& d) {
             d.put(d.once_in(8) ? 0 : d.magnitude(-4, 21));
             put_wo_and_u(d);
         },
         6, "3", ulp, 5},
        {"phong_lobe, _pdf, _albedo", of_phong_lobe, "exponents 0 … 2^21, powers and cosines 0 … 1",
         [](Draw& d) {
             d.put(d.once_in(8) ? 0 : d.magnitude(-4, 21));
             d.put(d.share());
         },
         2, "111", ulp, 5},
    };
}

std::vector<Function> bsdfs() {
    return {
        {"bsdf_delta_lobes", of_bsdf_delta_lobes, "cosines 0 … 1, any material",
         [](Draw& d) {
             d.put(d.share());
             put_material(d);
             d.put(static_cast<float>(d.bits() % 2));
         },
         15, "d3311", conditioned, 5, 0.13},
        {"refracted direction (bsdf_sample)", of_refracted,
         "upright and grazing by 10^-7; ratios 0.1 … 10, 1 ± 10^-7",
         [](Draw& d) {
             d.put(d.upper());
             d.put(d.index_ratio());
         },
         4, "d3", conditioned, 6, 0.02},
        {"lobe_probabilities", of_lobe_probabilities, "cosines 0 … 1, any material",
         [](Draw& d) {
             d.put(d.share());
             put_material(d);
         },
         15, "31", conditioned, 5},
        {"bsdf_albedo", of_bsdf_albedo, "upright and grazing, any material",
         [](Draw& d) {
             d.put(d.upper());
             put_material(d);
             d.put(static_cast<float>(d.bits() % 2));
         },
         17, "3", conditioned, 8},
        // The fits of repeated reflection (ggx_energy.h) lose digits where they are near 0, which
        // shows where a value has no other part. At a cosine of 10^-7 the diffuse lobe is what a
        // layer that reflects nearly all light lets through, a difference of nearly equal numbers.
        {"bsdf_eval_and_pdf", of_bsdf_eval_and_pdf,
         "upright and grazing, near the mirror's direction, any material", put_scattering, 20, "31",
         conditioned, 80},
        {"bsdf_eval", of_bsdf_eval,
         "as bsdf_eval_and_pdf, whose value is equal; any lobes, from below as well (below 10^-30 "
         "of absolute error)",
         put_scattering_by_lobes, 20, "3d", conditioned, 1e4},
        {"rough_clear_eval_and_pdf", of_rough_clear,
         "upright and grazing, near the mirror's and the refracted direction, any material with "
         "transmission",
         [](Draw& d) {
             put_scattering(d);
             d.x[15] = d.once_in(2) ? 1 : d.unit(); // transmission
             const float index = d.x[16];
             if (!d.once_in(3)) {
                 for (std::size_t i = 3; i < 5; ++i) {
                     d.x[i] /= index > 1 ? index : 1; // near the refracted direction
                 }
                 d.x[5] = -std::sqrt(std::max(1 - d.x[3] * d.x[3] - d.x[4] * d.x[4], 0.0f));
             }
             d.put(static_cast<float>(d.bits() % 2));
         },
         20, "31", conditioned, 100},
        {"bsdf_pdf", of_bsdf_pdf,
         "as bsdf_eval_and_pdf, whose density is equal; any lobes, from below as well (below "
         "10^-30 of absolute error)",
         put_scattering_by_lobes, 20, "1d", conditioned, 40},
    };
}

std::vector<Function> paths_and_samples() {
    return {
        {"followed_lobes, estimated_lobes, is_lambertian", of_followed_lobes,
         "any material, Lambertian ones among them; --follow-roughness 0 … 1 and equal to the "
         "material's",
         [](Draw& d) {
             d.put(d.share());
             put_material(d);
             if (d.once_in(3)) {
                 d.x[0] = d.x[9]; // roughness
             }
             if (d.once_in(4)) {
                 d.x[4] = d.x[8] = d.x[10] = 0; // metallic, specular, transmission
             }
         },
         0, "ddd", ulp, 0},
        {"state_after, layer_of_emission", of_path_state,
         "paths of 0 … 12 vertices, followed or estimated",
         [](Draw& d) {
             const auto vertices = static_cast<std::uint32_t>(d.bits() % 13);
             auto followed = static_cast<std::uint32_t>(d.bits() % 4096);
             // One estimated vertex.
             followed = d.once_in(3) ? followed : 4095u ^ (1u << (d.bits() % 13));
             d.put(static_cast<float>(vertices));
             d.put(static_cast<float>(followed & 4095u));
         },
         0, "ddd", ulp, 0},
        {"bsdf_sample", of_bsdf_sample, "upright and grazing, corners of [0, 1)³, any material",
         [](Draw& d) {
             put_wo_and_u(d);
             d.put(d.unit());
             put_material(d);
             d.put(static_cast<float>(d.bits() % 2));
         },
         20, "d331", conditioned, 200, 0.07},
    };
}

std::vector<Function> rays() {
    return {
        {"ray_shear", of_ray_shear, "components 2^-60 … 2^60, zeros",
         [](Draw& d) { d.put(d.once_in(2) ? d.direction() : d.nonzero_vector(-60, 60)); }, 3,
         "d111", ulp, 1},
        {"intersect_triangle", of_intersect_triangle,
         "through insides, edges, vertices and past them; along axes, grazing by 10^-7; 10^5 sizes "
         "away",
         [](Draw& d) { put_ray_and_triangle(d, false); }, 15, "d111", conditioned, 8, 0.3},
        {"intersect_triangle, slivers", of_intersect_sliver,
         "slivers of aspect 10^6, through insides and past them; position relative to the sliver's "
         "length",
         [](Draw& d) { put_ray_and_triangle(d, true); }, 15, "d3", conditioned, 2, 0.13},
        {"box_reach", of_box_reach,
         "points in boxes and outside, boxes of 2^-20 of their distance from the origin",
         [](Draw& d) {
             d.put(d.vector(-20, 20));
             const glm::vec3 low = d.vector(-20, 20);
             d.put(low);
             d.put(low + glm::abs(d.vector(-20, 20)));
         },
         9, "1", conditioned, 1.5},
        {"hit_point", of_hit_point, "insides, edges and vertices; slivers of 10^6, 10^5 sizes away",
         [](Draw& d) {
             const glm::dvec2 b = any_weights(d);
             d.put(static_cast<float>(b.x));
             d.put(static_cast<float>(b.y));
             put(d, any_triangle(d, d.once_in(4)));
         },
         11, "3", conditioned, 3},
        {"offset_ray_origin", of_offset_ray_origin,
         "points 2^-20 … 2^20, errors of 2^-20 of them, any side",
         [](Draw& d) {
             const glm::vec3 p = d.vector(-20, 20);
             const glm::vec3 n = d.direction();
             d.put(p);
             d.put(glm::vec3(std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)}) * 0x1p-20f));
             d.put(n);
             d.put(d.above(n) * d.sign());
         },
         12, "3", ulp, 4},
    };
}

std::vector<Function> surfaces_and_cameras() {
    return {
        {"normalize_or", of_normalize_or, "vectors 2^-100 … 2^100, zeros, any fallback",
         [](Draw& d) {
             const int middle = static_cast<int>(d.bits() % 180) - 90;
             d.put(d.once_in(4) ? glm::vec3(0) : d.nonzero_vector(middle - 10, middle + 10));
             d.put(d.direction());
         },
         6, "3", ulp, 4},
        {"make_surface", of_make_surface,
         "any point of any triangle, smooth normals up to 45° off, rays grazing by 10^-7",
         [](Draw& d) {
             const Triangle t = any_triangle(d, d.once_in(4));
             const glm::dvec2 b = any_weights(d);
             const glm::dvec3 exact = glm::cross(glm::dvec3(t.v1) - glm::dvec3(t.v0),
                                                 glm::dvec3(t.v2) - glm::dvec3(t.v0));
             const glm::vec3 n =
                 glm::length(exact) > 0 ? rounded(glm::normalize(exact)) : glm::vec3(0, 0, 1);
             d.put(static_cast<float>(b.x));
             d.put(static_cast<float>(b.y));
             d.put(-d.above(n) * d.sign());
             put(d, t);
             const bool smooth = !d.once_in(3);
             for (int i = 0; i < 3; ++i) {
                 d.put(smooth ? rounded(
                                    glm::normalize(glm::dvec3(n) + 0.7 * glm::dvec3(d.direction())))
                              : glm::vec3(0));
             }
         },
         23, "d333d", conditioned, 6, 0.45},
        {"camera_ray, perspective", of_camera_ray,
         "any pixel of images up to 4096², angles 7° … 90°, any position",
         [](Draw& d) { put_camera(d, false); }, 14, "33", conditioned, 6},
        {"camera_ray, orthographic", of_camera_ray,
         "any pixel of images up to 4096², any size and position",
         [](Draw& d) { put_camera(d, true); }, 14, "33", conditioned, 4},
    };
}

} // namespace

std::vector<Function> scatter_table() {
    return joined({microfacets(), phong_lobes(), bsdfs(), paths_and_samples(), rays(),
                   surfaces_and_cameras()});
}

} // namespace argand::testing
