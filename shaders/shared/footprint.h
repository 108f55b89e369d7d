// Footprints of photons: skewed ellipses in the tangent plane of the surface that a photon hit,
// with the normal as a third axis. Fabianowski and Dingliana 2009, sections 3.2 and 4.3.
// Derivations: docs/methods/footprints.md.
#ifndef ARGAND_SHARED_FOOTPRINT_H
#define ARGAND_SHARED_FOOTPRINT_H

#include "shared/differential.h"
#include "shared/footprint_records.h"

ARGAND_SHARED_BEGIN

// Semi-axes of the ellipsoid: u and v in the tangent plane, at any angle to each other, w along the
// normal.
struct Footprint {
    vec3 u, v, w;
};

// The vectors of the tangent plane that are dual to u and v: a·u = b·v = 1, a·v = b·u = 0. So
// (a·x)² + (b·x)² is the squared distance in units of the ellipse.
struct FootprintDuals {
    vec3 a, b;
};

// User settings of footprints. smoothing: in units of length^(3/4) for the reference number of
// photons; largest: semi-axis relative to the scene's length; exponent: footprints shrink as
// photons^-exponent, 1/6 by default, 1/2 in the paper, where the smoothing is constant.
struct FootprintTuning {
    real smoothing, caustic_smoothing;
    real largest;
    real flatness;
    real exponent;
};

// Footprint scale for a pass that emits `photons` photons. reference_photons: the number for which
// the smoothing is given. length: size of the scene. The caller sets principal_axes; here the
// differentials are the axes, as in the paper.
FN FootprintScale make_footprint_scale(real photons, real reference_photons, real length,
                                       IN(FootprintTuning) tuning) {
    real n = max(photons, real(1.0));
    real growth = pow_real(n / max(reference_photons, real(1.0)), real(0.5) - tuning.exponent);
    FootprintScale s;
    s.spacing = float32(sphere_spacing(n));
    // The factor length^(3/4) makes the powers of length add up to 1.
    s.diffuse =
        float32(tuning.smoothing * growth * sphere_spacing(n) * sqrt(length) * sqrt(sqrt(length)));
    s.caustic = float32(tuning.caustic_smoothing * growth);
    s.radius_min = float32(length * real(1e-6));
    s.radius_max = float32(length * tuning.largest);
    s.caustic_min = s.radius_min;
    s.caustic_max = s.radius_max;
    s.flatness = float32(tuning.flatness);
    s.principal_axes = 0u;
    s.splats = 0u;
    s.pad0 = s.pad1 = 0u;
    return s;
}

// Splats of Yao et al. 2010, section 6: discs of the radius h = size / sqrt(p), p = cos(theta) /
// d², where d is relative to the scene's length, and p is clamped to `densities`. sizes: of
// photons, and of caustic ones; C0 sqrt(A / N) there for both.
FN FootprintScale splat_scale(vec2 sizes, real length, vec2 densities, real flatness) {
    FootprintScale s;
    s.spacing = float32(length);
    s.diffuse = float32(sizes.x);
    s.caustic = float32(sizes.y / length);
    s.radius_min = float32(sizes.x / sqrt(densities.y));
    s.radius_max = float32(sizes.x / sqrt(densities.x));
    s.caustic_min = float32(sizes.y / sqrt(densities.y));
    s.caustic_max = float32(sizes.y / sqrt(densities.x));
    s.flatness = float32(flatness);
    s.principal_axes = 0u;
    s.splats = 1u;
    s.pad0 = s.pad1 = 0u;
    return s;
}

// What a splatted photon keeps in the place of its differential: a circle of the radius 1 /
// sqrt(p), not clamped, in the plane of the surface. direction: in which it travels; distance: of
// its ray's hit.
FN PhotonDifferential splat_differential(vec3 direction, real distance, vec3 normal) {
    real cosine = max(abs(dot3(direction, normal)), real(1e-6));
    real radius = max(distance / sqrt(cosine), real(1e-20)); // has a direction
    Frame frame = make_frame(normal);
    PhotonDifferential d = no_differential();
    d.dp_du = frame.x * radius;
    d.dp_dv = frame.y * radius;
    return d;
}

// Turns conjugate semi-axes of an ellipse into its principal axes, u the longer (one Jacobi
// rotation).
FN void make_principal(INOUT(vec3) u, INOUT(vec3) v) {
    real largest = max(max_component(abs(u)), max_component(abs(v)));
    if (!is_finite(largest) || !(largest > real(0.0))) {
        return;
    }
    vec3 a = u / largest;
    vec3 b = v / largest;
    real difference = dot3(a, a) - dot3(b, b);
    real product = real(2.0) * dot3(a, b);
    real both = sqrt(difference * difference + product * product);
    if (!(both > real(0.0))) {
        return; // a circle
    }
    // cos and sin of half the angle of (difference, product), without cancellation
    real c = sqrt(real(0.5) * (real(1.0) + abs(difference) / both)); // at least sqrt(1/2)
    real s = product / (real(2.0) * both * c);
    if (difference < real(0.0)) {
        real swap = c;
        c = abs(s);
        s = product < real(0.0) ? -swap : swap;
    }
    vec3 turned = (a * c + b * s) * largest;
    v = (b * c - a * s) * largest;
    u = turned;
}

// One semi-axis, clamped, and compressed unless the photon is a caustic photon (section 4.3).
FN vec3 footprint_axis(vec3 dp, vec3 normal, bool caustic, IN(FootprintScale) s) {
    real size;
    vec3 tangent = dp - normal * dot3(dp, normal);
    tangent = tangent -
              // removes the rounding error where dp is along the normal
              normal * dot3(tangent, normal);
    vec3 unit = unit_and_length(tangent, size);
    real spread = size / real(s.spacing);
    real radius = caustic ? size * real(s.caustic)
                          : real(s.diffuse) * (s.splats != 0u ? spread : sqrt(sqrt(spread)));
    return unit * (caustic ? clamp(radius, real(s.caustic_min), real(s.caustic_max))
                           : clamp(radius, real(s.radius_min), real(s.radius_max)));
}

// Footprint of a photon whose differential was transferred to its hit. normal: unit, geometric.
// caustic: only followed lobes scattered the photon since it left the light. Axes that are (nearly)
// parallel or zero are spread to radius_min.
FN Footprint make_footprint(IN(PhotonDifferential) d, vec3 normal, bool caustic,
                            IN(FootprintScale) s) {
    vec3 u = limit_length(d.dp_du, LARGEST_OFFSET);
    vec3 v = limit_length(d.dp_dv, LARGEST_OFFSET);
    if (s.principal_axes != 0u) {
        make_principal(u, v);
    }
    Footprint f;
    f.u = footprint_axis(u, normal, caustic, s);
    f.v = footprint_axis(v, normal, caustic, s);
    real size_u, size_v, sine;
    vec3 unit_u = unit_and_length(f.u, size_u);
    vec3 unit_v = unit_and_length(f.v, size_v);
    unit_and_length(cross3(unit_u, unit_v), sine);
    real least = real(min(s.radius_min, s.caustic_min));
    real longer = max(size_u, size_v);
    if (!(longer > real(0.0))) {
        Frame frame = make_frame(normal);
        f.u = frame.x * least;
        f.v = frame.y * least;
    } else if (!(min(size_u, size_v) * sine > least)) {
        // Keep the longer axis, and make the other perpendicular to it with the ellipse's width.
        vec3 along = size_u >= size_v ? unit_u : unit_v;
        f.u = along * longer;
        f.v = cross3(normal, along) * max(min(size_u, size_v) * sine, least);
    }
    f.w = normal * (real(s.flatness) * parallelogram_side(f.u, f.v));
    return f;
}

FN real footprint_area(IN(Footprint) f) { return PI * sqr(parallelogram_side(f.u, f.v)); }

// make_footprint guarantees that the parallelogram of the semi-axes has a positive area.
FN FootprintDuals footprint_duals(IN(Footprint) f, vec3 normal) {
    real size_u, size_v;
    vec3 unit_u = unit_and_length(f.u, size_u);
    vec3 unit_v = unit_and_length(f.v, size_v);
    real sine = dot3(cross3(unit_u, unit_v), normal);
    sine = sine < real(0.0) ? min(sine, real(-1e-12)) : max(sine, real(1e-12));
    FootprintDuals duals;
    duals.a = cross3(unit_v, normal) / (sine * max(size_u, real(1e-30)));
    duals.b = cross3(normal, unit_u) / (sine * max(size_v, real(1e-30)));
    return duals;
}

// Radius of the disc that has the footprint's area. The area spanned by the dual axes is the
// inverse of that of the axes, because the axes are perpendicular to the normal and not parallel.
FN real mean_radius(IN(FootprintDuals) duals) {
    return real(1.0) / max(parallelogram_side(duals.a, duals.b), real(1e-30));
}

// The ellipsoid with these dual axes, for bounding boxes around the stored footprint. Packing tilts
// normal and dual axes slightly; this ellipsoid still is exactly the region where footprint_weight
// is not 0.
FN Footprint footprint_of_duals(IN(FootprintDuals) duals, vec3 normal, real flatness) {
    real size_a, size_b;
    vec3 unit_a = unit_and_length(duals.a, size_a);
    vec3 unit_b = unit_and_length(duals.b, size_b);
    vec3 across = cross3(unit_a, unit_b);
    real sine = dot3(across, normal);
    sine = sine < real(0.0) ? min(sine, real(-1e-12)) : max(sine, real(1e-12));
    Footprint f;
    f.u = cross3(unit_b, normal) / (sine * max(size_a, real(1e-30)));
    f.v = cross3(normal, unit_a) / (sine * max(size_b, real(1e-30)));
    f.w = across * (flatness * parallelogram_side(f.u, f.v) / sine);
    return f;
}

// Half extents of the ellipsoid's bounding box.
FN vec3 footprint_extent(IN(Footprint) f) {
    vec3 largest = max(max(abs(f.u), abs(f.v)), abs(f.w));
    // Scaled so that no square underflows.
    real scale = max(max_component(largest), real(1e-30));
    vec3 u = f.u / scale;
    vec3 v = f.v / scale;
    vec3 w = f.w / scale;
    vec3 squares = u * u + v * v + w * w;
    return vec3(sqrt(squares.x), sqrt(squares.y), sqrt(squares.z)) * scale;
}

// Kernel at the squared distance q. Its integral over the unit disc is pi.
FN real footprint_kernel(real q, bool uniform_kernel) {
    return uniform_kernel ? real(1.0) : real(2.0) * max(real(0.0), real(1.0) - q);
}

// Irradiance per flux [1/length²] at `offset` from a photon, on a surface with unit normal
// query_normal: the kernel divided by the area of the ellipse in which the query's tangent plane,
// moved through the photon, intersects the ellipsoid. So flux is conserved on that plane however it
// is tilted. 0 outside the ellipsoid.
FN real footprint_weight(IN(FootprintDuals) f, vec3 normal, vec3 query_normal, vec3 offset,
                         real flatness, bool uniform_kernel) {
    real x = dot3(f.a, offset);
    real y = dot3(f.b, offset);
    real inverse_area = abs(dot3(cross3(f.a, f.b), normal)); // of the parallelogram of u and v
    real inverse_height2 = inverse_area / (flatness * flatness);
    real z = dot3(normal, offset);
    real q = x * x + y * y + z * z * inverse_height2;
    if (!(q <= real(1.0))) {
        return real(0.0);
    }
    // Components of the query's normal along u, v and w, over |w|; u = (b × n) / [a b n], v = (n ×
    // a) / [a b n].
    real along_u = dot3(cross3(f.b, normal), query_normal);
    real along_v = dot3(cross3(normal, f.a), query_normal);
    real along_w = dot3(normal, query_normal);
    real tilt2 = (along_u * along_u + along_v * along_v) / (inverse_area * flatness * flatness) +
                 along_w * along_w;
    return footprint_kernel(q, uniform_kernel) * INV_PI * inverse_area * sqrt(tilt2);
}

// Packs a dual axis into 3 × 16 bits, in units of the power of two above its largest component, and
// that unit's sign and exponent into the last 16. The error is below 2^-15 of the largest
// component, at any magnitude of single precision.
FN uvec2 pack_dual(vec3 v) {
    real largest = clamp(max_component(abs(v)), real(1e-30), real(1e30));
    uint exponent = (float_bits(float32(largest)) & 0x7f800000u) + 0x00800000u;
    vec3 scaled = v * (real(32767.0) / real(bits_float(exponent)));
    uint x = uint(floor(clamp(scaled.x, real(-32767.0), real(32767.0)) + real(32768.5)));
    uint y = uint(floor(clamp(scaled.y, real(-32767.0), real(32767.0)) + real(32768.5)));
    uint z = uint(floor(clamp(scaled.z, real(-32767.0), real(32767.0)) + real(32768.5)));
    return uvec2(x | (y << 16u), z | exponent);
}

FN vec3 unpack_dual(uint xy, uint zs) {
    real scale = real(bits_float(zs & 0xffff0000u)) / real(32767.0);
    return vec3(real(xy & 0xffffu) - real(32768.0), real(xy >> 16u) - real(32768.0),
                real(zs & 0xffffu) - real(32768.0)) *
           scale;
}

FN FootprintDuals unpack_duals(uvec4 packed) {
    FootprintDuals duals;
    duals.a = unpack_dual(packed.x, packed.y);
    duals.b = unpack_dual(packed.z, packed.w);
    return duals;
}

ARGAND_SHARED_END

#endif
