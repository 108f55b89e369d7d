// Maths of the sky's picture. Radiance is linear in the azimuth and in the cosine of the angle from
// +Y between the middles of texels (equal shares of the solid angle), and constant from the first
// and the last row to the pole. So the integral over a cell is its solid angle times the mean of
// its corners, and directions are sampled exactly in proportion to brightness.
#ifndef ARGAND_SHARED_SKY_H
#define ARGAND_SHARED_SKY_H

#include "shared/aim_records.h"
#include "shared/cone.h"
#include "shared/sky_record.h"

ARGAND_SHARED_BEGIN

// A point of the picture: a cell, which lies between the texels of a column and the next one, and
// the shares of its width and of its solid angle before the point, in [0, 1).
struct SkyCell {
    uint row, column;
    real x, y;
};

struct SkyCorners {
    vec3 top_left, top_right, bottom_left, bottom_right;
};

// What is seen in a direction.
struct SkyPoint {
    vec3 radiance;
    real pdf; // with which sample_sky finds the direction [1/sr]
};

FN vec3 sky_radiance(uvec2 texel) {
    real scale = real(bits_float((texel.y >> 22u) << 23u));
    uint g = texel.x >> 18u | (texel.y & 15u) << 14u;
    return vec3(real(texel.x & 0x3ffffu), real(g), real(texel.y >> 4u & 0x3ffffu)) * scale;
}

FN real sky_brightness(vec3 radiance) { return mean_component(radiance); }

// A number in [0, 1) with a density that is linear from a at 0 to b at 1.
FN real sample_linear(real a, real b, real u) {
    real largest = max(a, b);
    if (!(largest > real(0.0))) {
        return u;
    }
    real p = a / largest;
    real q = b / largest;
    // (p x + (q - p) x²/2) = u (p + q)/2, in the form that does not cancel.
    real root = sqrt((real(1.0) - u) * p * p + u * q * q) + p;
    return root > real(0.0) ? min(u * (p + q) / root, LARGEST_BELOW_1) : real(0.0);
}

// The inverse of sample_linear.
FN real number_of_linear(real a, real b, real x) {
    real sum = a + b;
    return sum > real(0.0) ? (real(2.0) * a * x + (b - a) * x * x) / sum : x;
}

FN vec3 radiance_in_cell(IN(SkyCorners) c, real x, real y) {
    return mix(mix(c.top_left, c.top_right, x), mix(c.bottom_left, c.bottom_right, x), y);
}

FN real brightness_of_cell(IN(SkyCorners) c) {
    return sky_brightness(c.top_left + c.top_right + c.bottom_left + c.bottom_right) * real(0.25);
}

// Brightness of the cell's left and right edge at y, or of its upper and lower edge.
FN vec2 brightness_of_sides(IN(SkyCorners) c, real y) {
    return vec2(sky_brightness(mix(c.top_left, c.bottom_left, y)),
                sky_brightness(mix(c.top_right, c.bottom_right, y)));
}

FN vec2 brightness_of_rows(IN(SkyCorners) c) {
    return vec2(sky_brightness(c.top_left + c.top_right),
                sky_brightness(c.bottom_left + c.bottom_right));
}

// A direction in the picture's frame from that in the world, or the reverse. turn: cosine and sine,
// see sky_turn.
FN vec3 to_picture(vec3 d, vec2 turn) {
    return vec3(d.x * turn.x - d.z * turn.y, d.y, d.x * turn.y + d.z * turn.x);
}

FN vec3 from_picture(vec3 d, vec2 turn) {
    return vec3(d.x * turn.x + d.z * turn.y, d.y, d.z * turn.x - d.x * turn.y);
}

// sin²(t/2) and cos²(t/2) of a unit vector's angle t from +Y, to a small relative error.
FN vec2 halved_angle(vec3 d) {
    real r2 = d.x * d.x + d.z * d.z;
    real sine2 = d.y > real(0.0) ? real(0.5) * r2 / (real(1.0) + d.y) : real(0.5) - real(0.5) * d.y;
    real cosine2 =
        d.y > real(0.0) ? real(0.5) + real(0.5) * d.y : real(0.5) * r2 / (real(1.0) - d.y);
    return vec2(sine2, cosine2);
}

// The share of a row of cells that lies above an angle. above, below: of the row's borders.
FN real share_above(vec2 angle, vec2 above, vec2 below) {
    bool upper = angle.x < angle.y;
    real share = upper ? (angle.x - above.x) / (below.x - above.x)
                       : (above.y - angle.y) / (above.y - below.y);
    return clamp(share, real(0.0), LARGEST_BELOW_1);
}

// The unit vector at this azimuth, in turns, and angle from +Y.
FN vec3 sky_direction(real turn, vec2 angle) {
    real s, c;
    sincos_2pi(turn, s, c);
    real sine = real(2.0) * sqrt(angle.x * angle.y);
    return vec3(sine * c, angle.y - angle.x, sine * s);
}

ARGAND_SHARED_END

#endif
