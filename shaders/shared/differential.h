// Photon differentials: how a photon's position and direction change with the two parameters of its
// emission, times the spacing of neighbouring photons in these parameters. Where n photons are
// distributed with density p, the two differentials of a photon span a parallelogram of area 1 / (n
// p). Fabianowski and Dingliana 2009, "Interactive Global Photon Mapping", section 4, whose
// equations are cited here by number; Igehy 1999, "Tracing Ray Differentials". Derivations:
// docs/methods/footprints.md.
#ifndef ARGAND_SHARED_DIFFERENTIAL_H
#define ARGAND_SHARED_DIFFERENTIAL_H

#include "shared/frame.h"
#include "shared/surface.h"

ARGAND_SHARED_BEGIN

struct PhotonDifferential {
    vec3 dp_du, dp_dv; // of the position [length]
    vec3 dd_du, dd_dv; // of the unit direction, perpendicular to it
};

// A surface's unit normal, and its changes with the same two parameters.
struct NormalDifferential {
    vec3 n;
    vec3 dn_du, dn_dv;
};

// Clamps far above any meaningful differential; they keep products of several finite.
CONSTANT real LARGEST_SPREAD = real(1e3);
CONSTANT real LARGEST_OFFSET = real(1e15);
// Rays that graze a plane at a smaller cosine are treated as if they met it at this one.
CONSTANT real SMALLEST_COSINE = real(1e-6);
// Least cosine in the emission density: about one photon in a million is emitted below it.
CONSTANT real SMALLEST_EMISSION_COSINE = real(1e-3);

// v, shortened to at most `most`; (0,0,0) if v is not finite.
FN vec3 limit_length(vec3 v, real most) {
    real size;
    vec3 unit = unit_and_length(v, size);
    return unit * min(size, most);
}

// Square root of the area of the parallelogram of a and b; neither over- nor underflows.
FN real parallelogram_side(vec3 a, vec3 b) {
    real size_a, size_b, sine;
    vec3 unit_a = unit_and_length(a, size_a);
    vec3 unit_b = unit_and_length(b, size_b);
    unit_and_length(cross3(unit_a, unit_b), sine);
    return sqrt(size_a) * sqrt(size_b) * sqrt(sine);
}

// Distance between neighbours among n photons with this density over directions or areas; eq. 5 for
// the density 1 / 4 pi.
FN real photon_spacing(real photons, real density) {
    return real(1.0) / sqrt(max(photons, real(1.0)) * max(density, real(1e-30)));
}

// The spacing Δ of eq. 9.
FN real sphere_spacing(real photons) { return photon_spacing(photons, UNIFORM_SPHERE_PDF); }

// The unit vectors of eq. 8 for a direction in polar coordinates around f.z. At the pole, where
// they are undefined, any two perpendicular ones.
FN void direction_axes(IN(Frame) f, vec3 direction, OUT(vec3) along_cosine, OUT(vec3) around) {
    real sine;
    vec3 local = vec3(-dot3(f.y, direction), dot3(f.x, direction), real(0.0));
    vec3 unit = unit_and_length(local, sine);
    around = to_world(f, sine > real(0.0) ? unit : vec3(real(0.0), real(1.0), real(0.0)));
    // Rounding leaves `around` not quite perpendicular to the direction.
    around = unit_and_length(around - direction * dot3(around, direction), sine);
    along_cosine = cross3(direction, around);
}

FN PhotonDifferential no_differential() {
    PhotonDifferential d;
    d.dp_du = vec3(real(0.0));
    d.dp_dv = vec3(real(0.0));
    d.dd_du = vec3(real(0.0));
    d.dd_dv = vec3(real(0.0));
    return d;
}

// Transfers an offset along a ray of unit direction to its hit at distance t, on a plane with unit
// normal n (either side): Igehy's eqs. 10 and 12, written as one double cross product, which lies
// in the plane even for grazing rays.
FN vec3 transferred_offset(vec3 dp, vec3 dd, vec3 direction, real t, vec3 n) {
    real cosine = dot3(direction, n);
    cosine = cosine < real(0.0) ? min(cosine, -SMALLEST_COSINE) : max(cosine, SMALLEST_COSINE);
    return limit_length(cross3(n, cross3(dp + dd * t, direction)) / cosine, LARGEST_OFFSET);
}

FN void transfer_differential(INOUT(PhotonDifferential) d, vec3 direction, real t, vec3 n) {
    d.dp_du = transferred_offset(d.dp_du, d.dd_du, direction, t, n);
    d.dp_dv = transferred_offset(d.dp_dv, d.dd_dv, direction, t, n);
}

// Change of the interpolated unit normal for a step dp within a triangle, at the barycentric
// weights b of its second and third vertex. shading_normal: as make_surface returned it. Where that
// fell back to the flat normal, or the triangle has no area, the change is 0.
FN vec3 shading_normal_change(IN(SmoothTriangle) t, vec2 b, vec3 shading_normal, vec3 dp) {
    real size, size1, size2, sine;
    vec3 unit = unit_and_length(t.n0 * (real(1.0) - b.x - b.y) + t.n1 * b.x + t.n2 * b.y, size);
    vec3 edge1 = unit_and_length(t.v1 - t.v0, size1);
    vec3 edge2 = unit_and_length(t.v2 - t.v0, size2);
    vec3 flat_normal = unit_and_length(cross3(edge1, edge2), sine);
    real side = dot3(unit, shading_normal) < real(0.0) ? real(-1.0) : real(1.0);
    bool interpolated = max_component(abs(unit * side - shading_normal)) < real(1e-3);
    if (!(size > real(0.0)) || !(sine > real(0.0)) || !interpolated) {
        return vec3(real(0.0));
    }
    // Changes of the weights. The edges have positive lengths because `sine` is positive.
    real b1 = dot3(cross3(dp, edge2), flat_normal) / sine / size1;
    real b2 = dot3(cross3(edge1, dp), flat_normal) / sine / size2;
    vec3 change = (t.n1 - t.n0) * b1 + (t.n2 - t.n0) * b2;
    return (change - unit * dot3(unit, change)) * (side / size);
}

// Reflection at a surface whose unit normal n changes by dn: Igehy's eq. 15.
FN vec3 reflected_spread(vec3 dd, vec3 direction, vec3 n, vec3 dn) {
    real change = dot3(dd, n) + dot3(direction, dn);
    return limit_length(dd - (dn * dot3(direction, n) + n * change) * real(2.0), LARGEST_SPREAD);
}

// Refraction at a surface with unit normal n on the incident side. eta > 0: index of the far side
// over that of the near side. Igehy's eqs. 17 and 18 with their differences taken analytically, so
// that an index of 1 leaves the differential unchanged to the bit. Near total reflection the spread
// diverges; it is clamped to LARGEST_SPREAD.
FN vec3 refracted_spread(vec3 dd, vec3 direction, vec3 n, vec3 dn, real eta) {
    real ratio = real(1.0) / max(eta, real(1e-6));
    real cosine = max(-dot3(direction, n), real(0.0));
    real k = ((eta - real(1.0)) * (eta + real(1.0)) + cosine * cosine) * ratio * ratio;
    real refracted = max(safe_sqrt(k), SMALLEST_COSINE);
    // direction' = ratio direction + step n
    real step =
        (real(1.0) - eta) * (real(1.0) + eta) * ratio * ratio / (ratio * cosine + refracted);
    real change = ratio * step / refracted * (dot3(dd, n) + dot3(direction, dn));
    return limit_length(dd * ratio + n * change + dn * step, LARGEST_SPREAD);
}

FN void reflect_differential(INOUT(PhotonDifferential) d, vec3 direction,
                             IN(NormalDifferential) normal) {
    d.dd_du = reflected_spread(d.dd_du, direction, normal.n, normal.dn_du);
    d.dd_dv = reflected_spread(d.dd_dv, direction, normal.n, normal.dn_dv);
}

FN void refract_differential(INOUT(PhotonDifferential) d, vec3 direction,
                             IN(NormalDifferential) normal, real eta) {
    d.dd_du = refracted_spread(d.dd_du, direction, normal.n, normal.dn_du, eta);
    d.dd_dv = refracted_spread(d.dd_dv, direction, normal.n, normal.dn_dv, eta);
}

// Russian roulette (section 4.2): the photon survived with this probability, so its footprint's
// area is divided by it. Also accounts for the choice of a lobe and for light that a thin or partly
// covering surface lets straight through, and above 1 for photons that are denser than without
// aiming.
FN void roulette_differential(INOUT(PhotonDifferential) d, real probability) {
    real factor = real(1.0) / sqrt(clamp(probability, real(1e-6), real(1e9)));
    d.dp_du = limit_length(d.dp_du * factor, LARGEST_OFFSET);
    d.dp_dv = limit_length(d.dp_dv * factor, LARGEST_OFFSET);
    d.dd_du = limit_length(d.dd_du * factor, LARGEST_SPREAD);
    d.dd_dv = limit_length(d.dd_dv * factor, LARGEST_SPREAD);
}

// Adds a spread of directions that is independent of the positions. The added offsets are a quarter
// turn from the existing ones, so that areas add as variances do: |dp|² + t² spread². The turn is
// relative to the orthogonal factor of the offsets' polar decomposition, which leaves no mixed
// term.
FN void add_independent_spread(INOUT(PhotonDifferential) d, vec3 direction, real spread) {
    Frame f = make_frame(direction);
    real size_u, size_v;
    vec3 unit_u = unit_and_length(d.dp_du, size_u);
    vec3 unit_v = unit_and_length(d.dp_dv, size_v);
    real largest = max(size_u, size_v);
    vec2 u = vec2(real(1.0), real(0.0));
    vec2 v = vec2(real(0.0), real(1.0));
    if (largest > real(0.0)) {
        u = vec2(dot3(f.x, unit_u), dot3(f.y, unit_u)) * (size_u / largest);
        v = vec2(dot3(f.x, unit_v), dot3(f.y, unit_v)) * (size_v / largest);
    }
    real side = u.x * v.y - u.y * v.x < real(0.0) ? real(-1.0) : real(1.0);
    real size;
    vec3 turned = unit_and_length(vec3(u.x + side * v.y, u.y - side * v.x, real(0.0)), size);
    turned = size > real(0.0) ? turned : vec3(real(1.0), real(0.0), real(0.0));
    d.dd_du = limit_length(d.dd_du + (f.y * turned.x - f.x * turned.y) * spread, LARGEST_SPREAD);
    d.dd_dv =
        limit_length(d.dd_dv - (f.x * turned.x + f.y * turned.y) * (side * spread), LARGEST_SPREAD);
}

// How a diffuse surface emits photons again:
// - PAPER: spaces directions as over a whole sphere and matches the areas of footprint and beam
//   (eqs. 10 to 13).
// - COSINE: spaces directions as they are sampled, with density cos θ / pi over the hemisphere, and
//   matches footprints on the surface.
// - INDEPENDENT: like COSINE, but positions and directions are independent spreads.
CONSTANT uint REEMIT_PAPER = 0u;
CONSTANT uint REEMIT_COSINE = 1u;
CONSTANT uint REEMIT_INDEPENDENT = 2u;

// Differential after diffuse reflection (or transmission) on the side of frame.z, the shading
// normal, at the hit that d was transferred to. photons: all photons of the pass, including those
// lost on the way, because Russian roulette has enlarged d accordingly.
FN PhotonDifferential reemitted_differential(IN(PhotonDifferential) d, IN(Frame) frame,
                                             vec3 direction, real photons, uint mode) {
    PhotonDifferential next = no_differential();
    real cosine = max(abs(dot3(direction, frame.z)), SMALLEST_EMISSION_COSINE);
    real spread =
        photon_spacing(photons, mode == REEMIT_PAPER ? UNIFORM_SPHERE_PDF : cosine * INV_PI);
    if (mode == REEMIT_INDEPENDENT) {
        next.dp_du = d.dp_du;
        next.dp_dv = d.dp_dv;
        add_independent_spread(next, direction, spread);
        return next;
    }
    // Width of the beam, perpendicular to it, where it leaves the surface: the distance of the
    // virtual origin times the spread.
    real side = parallelogram_side(d.dp_du, d.dp_dv);
    side = min(mode == REEMIT_PAPER ? side : side * sqrt(cosine), LARGEST_OFFSET);
    vec3 axis_u, axis_v;
    direction_axes(frame, direction, axis_u, axis_v);
    next.dp_du = axis_u * side;
    next.dp_dv = axis_v * side;
    next.dd_du = axis_u * spread;
    next.dd_dv = axis_v * spread;
    return next;
}

// How a facet's normal turns with the shading normal.
FN NormalDifferential turned_with(IN(NormalDifferential) normal, vec3 facet) {
    NormalDifferential turned;
    turned.n = facet;
    real cosine = dot3(normal.n, facet);
    turned.dn_du = normal.dn_du * cosine - normal.n * dot3(normal.dn_du, facet);
    turned.dn_dv = normal.dn_dv * cosine - normal.n * dot3(normal.dn_dv, facet);
    return turned;
}

// Adds the spread of a rough lobe that sampled the outgoing direction with this solid-angle
// density.
FN void add_lobe_spread(INOUT(PhotonDifferential) d, vec3 outgoing, real photons, real density) {
    real least = SMALLEST_EMISSION_COSINE * INV_PI;
    add_independent_spread(d, outgoing, photon_spacing(photons, max(density, least)));
}

// Glossy reflection into a direction sampled with this solid-angle density. The incoming
// differential is mirrored at the half vector, which turns with the shading normal; the lobe's own
// spread is independent of it.
FN void gloss_differential(INOUT(PhotonDifferential) d, vec3 incoming, vec3 outgoing,
                           IN(NormalDifferential) normal, real photons, real density) {
    real size;
    vec3 facet = unit_and_length(outgoing - incoming, size);
    reflect_differential(d, incoming, turned_with(normal, facet));
    add_lobe_spread(d, outgoing, photons, density);
}

// Rough glass, into a direction sampled with this solid-angle density: reflection, refraction at a
// facet, or what a thin wall lets through, which is a reflection mirrored at the surface. eta:
// index of the far side over that of the near side, 1 for the other two.
FN void rough_clear_differential(INOUT(PhotonDifferential) d, vec3 incoming, vec3 outgoing,
                                 IN(NormalDifferential) normal, real eta, real photons,
                                 real density) {
    real size;
    if (dot3(outgoing, normal.n) > real(0.0)) {
        gloss_differential(d, incoming, outgoing, normal, photons, density);
        return;
    }
    if (eta == real(1.0)) {
        vec3 mirrored = outgoing - normal.n * (real(2.0) * dot3(outgoing, normal.n));
        vec3 facet = unit_and_length(mirrored - incoming, size);
        reflect_differential(d, incoming, turned_with(normal, facet));
        reflect_differential(d, mirrored, normal);
    } else {
        vec3 facet = unit_and_length(outgoing * eta - incoming, size);
        facet = dot3(facet, normal.n) < real(0.0) ? -facet : facet;
        refract_differential(d, incoming, turned_with(normal, facet), eta);
    }
    add_lobe_spread(d, outgoing, photons, density);
}

ARGAND_SHARED_END

#endif
