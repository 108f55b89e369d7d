#ifndef ARGAND_SHARED_PHOTON_H
#define ARGAND_SHARED_PHOTON_H

#include "shared/frame.h"
#include "shared/maths.h"
#include "shared/photon_records.h"

ARGAND_SHARED_BEGIN

// The highest bit of a photon's code tells whether it is a caustic photon. kind_distance is the
// code distance of two photons that differ in it.
CONSTANT uint photon_kind_bit = 0x80000000u;
CONSTANT uint kind_distance = 95u;

// A packed photon normal: a unit vector in 2×15 bits, the caustic bit, and on top the area sample
// bit. All bits set: the slot holds no record.
CONSTANT uint no_photon = 0xffffffffu;
CONSTANT uint photon_normal_mask = 0x3fffffffu;
CONSTANT uint photon_caustic_bit = 0x40000000u;
CONSTANT uint area_sample_bit = 0x80000000u;

FN uint pack_photon_normal(vec3 normal, bool caustic) {
    uint packed = pack_unit(normal);
    uint x = (packed & 0xffffu) >> 1;
    uint y = packed >> 17;
    return x | (y << 15) | (caustic ? photon_caustic_bit : 0u);
}

FN vec3 unpack_photon_normal(uint packed) {
    uint x = (packed & 0x7fffu) << 1;
    uint y = ((packed >> 15) & 0x7fffu) << 1;
    return unpack_unit(x | (y << 16));
}

// Larger counts of scatterings are stored as this one.
CONSTANT uint most_scatterings_known = 63u;

// The number with these five lowest bits that is nearest to a coordinate of pack_unit.
FN uint with_lowest_bits(uint coordinate, uint bits) {
    uint above = coordinate + 16u;
    return (min(above > bits ? above - bits : 0u, 0xffffu) & 0xffe0u) | bits;
}

// Packs the direction from which a photon came. In the lowest bits of both coordinates are its
// number of scatterings and half of `aimed`, the logarithm to base 2 of the density of photons
// like it over that of the rarest, at most 31. unpack_unit can read it as it is; the direction is
// then off by at most 3e-3, and the mean of many by at most 6.5e-5.
FN uint pack_photon_direction(vec3 direction, uint scatterings, uint aimed) {
    uint n = scatterings < most_scatterings_known ? scatterings : most_scatterings_known;
    uint packed = pack_unit(direction);
    uint low = with_lowest_bits(packed & 0xffffu, (n & 7u) | ((aimed & 6u) << 2));
    uint high = with_lowest_bits(packed >> 16, (n >> 3) | (aimed & 0x18u));
    return low | (high << 16);
}

FN uint photon_scatterings(uint packed) { return (packed & 7u) | ((packed >> 13) & 0x38u); }

// How rare photons like this one are because others were aimed: one over the density of
// pack_photon_direction, a power of 4 and at most 1.
FN real photon_rarity(uint packed) {
    uint aimed = ((packed >> 2) & 6u) | ((packed >> 16) & 0x18u);
    return bits_float((127u - aimed) << 23);
}

FN bool photon_is_caustic(uint packed) { return (packed & photon_caustic_bit) != 0u; }

// Epanechnikov's kernel in two dimensions: squared_distance is in the tangent plane, in units of
// the squared radius r2. Times kernel_scale / r2 its integral over the disc is 1.
FN real kernel_weight(real squared_distance) {
    return max(real(0.0), real(1.0) - squared_distance);
}

CONSTANT real kernel_scale = real(0.63661977236758134308); // 2 / π

// Estimates are divided by at least this share of a disc on surfaces: a smaller value, known from
// few area samples, is not trusted.
CONSTANT real least_divisor = real(0.1);

// Height of the disc of density estimation, over its radius: what lies higher over a surface does
// not belong to it.
CONSTANT real disc_half_height = real(0.1);
// A chord of a circle is at the same angle to the normals at its two ends, so that the sum of the
// normals is perpendicular to it. Of points of one smooth surface that holds nearly, also where it
// is curved. Meshes bend at edges instead of evenly, which leaves at most the angle between the
// normals. This is the most that may be left: the component of a unit chord along the sum of the
// normals.
CONSTANT real chord_tolerance = real(0.1);
// The same where the normals are equal; it covers the error of packed normals. Parallel layers fail
// unless the chord is 1,000 times as long as their distance: a closed white shell holds much light
// between its layers.
CONSTANT real flat_tolerance = real(0.002);
// Error of the height of a point of a plane over that plane, relative to the largest coordinate:
// some units of single precision, as hits have.
CONSTANT real position_rounding = real(9.5e-7);
// Photons whose normal is at an angle with a cosine below this belong to another surface: 32°. With
// 60°, estimates on columns and mouldings thinner than the disc mix lit and shaded sides.
CONSTANT real same_surface_cosine = real(0.85);
// Square of the most that a unit chord then rises over the tangent plane: the sine of half that
// angle, and half the tolerance.
CONSTANT real steepest_chord = real(0.105);

// Height of the rays from photons and area samples to points in view, over their length. What
// curves up more hides as a wall does.
CONSTANT real view_link_height = real(0.1);

// The logarithm to base 2, rounded down, of the density of aimed photons over that without aiming;
// 0 where it is below 2.
FN uint aimed_by(real concentration) {
    real most = real(1u << largest_photon_aimed);
    return uint(findMSB(uint(clamp(concentration, real(1.0), most))));
}

// Rounds a flux to units of the fixed-point sums, which hold at most 2^32 - 2^8.
FN uint flux_units(real flux, real unit) {
    return uint(min(floor(flux / unit + real(0.5)), real(4294967040.0)));
}
FN uvec3 flux_units(vec3 flux, real unit) {
    return uvec3(flux_units(flux.x, unit), flux_units(flux.y, unit), flux_units(flux.z, unit));
}

ARGAND_SHARED_END

#endif
