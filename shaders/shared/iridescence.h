// Reflectance of a thin film on a surface, KHR_materials_iridescence: interference between what the
// film and what the surface under it reflect, integrated over the spectrum (Belcour and Barla 2017,
// "A Practical Extension to Microfacet Theory for the Modeling of Varying Iridescence"). The film
// lies in air; Fresnel factors follow Schlick's approximation, as in the extension.
#ifndef ARGAND_SHARED_IRIDESCENCE_H
#define ARGAND_SHARED_IRIDESCENCE_H

#include "shared/fresnel.h"

ARGAND_SHARED_BEGIN

// What eyes see of cos(2 pi path/wavelength + shift), as RGB. path: optical path difference
// [micrometres]; shift: for X, Y and Z, in turns. Gaussian fits to the colour matching functions.
FN vec3 film_sensitivity(real path, vec3 shift) {
    vec3 turns = vec3(real(1.6810), real(1.7953), real(2.2084)) * path + shift;
    real extra_turns = real(2.2399) * path + shift.x;
    real path2 = path * path;
    real sine;
    vec3 c;
    real extra;
    sincos_2pi(turns.x, sine, c.x);
    sincos_2pi(turns.y, sine, c.y);
    sincos_2pi(turns.z, sine, c.z);
    sincos_2pi(extra_turns, sine, extra);
    real x = real(0.84659) * c.x * exp_negative(real(-0.17085470) * path2) +
             real(0.15386831) * extra * exp_negative(real(-0.17876617) * path2);
    real y = real(1.00022189) * c.y * exp_negative(real(-0.36733088) * path2);
    real z = real(1.00112249) * c.z * exp_negative(real(-0.26103525) * path2);
    // XYZ to linear sRGB
    return vec3(real(3.2404542) * x - real(1.5371385) * y - real(0.4985314) * z,
                real(-0.9692660) * x + real(1.8760108) * y + real(0.0415560) * z,
                real(0.0556434) * x - real(0.2040259) * y + real(1.0572252) * z);
}

// Square of the ratio of amplitudes that a boundary between two indices reflects along the normal.
FN real normal_reflectance(real index, real other) {
    real r = (index - other) / (index + other); // both are positive
    return r * r;
}

// Reflectance of the film on a surface of this reflectance at normal incidence, below 1. index: of
// the film, at least 1; thickness [micrometres]; cosine: with the (microfacet's) normal, in [0, 1].
FN vec3 film_reflectance(vec3 f0, real film_index, real thickness, real cosine) {
    // Films below 0.03 nm fade away.
    real s = clamp(thickness / real(3.0e-5), real(0.0), real(1.0));
    real index = real(1.0) + (film_index - real(1.0)) * (s * s * (real(3.0) - real(2.0) * s));
    // cos² in the film, by Snell's law; at least 0 because the index is at least 1.
    real inside2 = real(1.0) - (real(1.0) - cosine * cosine) / (index * index);
    real inside = safe_sqrt(inside2);
    real outer = fresnel_schlick(vec3(normal_reflectance(index, real(1.0))), real(1.0), cosine).x;
    real passed = (real(1.0) - outer) * (real(1.0) - outer);
    // The surface's index that gives its reflectance in air.
    vec3 root =
        vec3(sqrt(clamp(f0.x, real(0.0), real(0.9999))), sqrt(clamp(f0.y, real(0.0), real(0.9999))),
             sqrt(clamp(f0.z, real(0.0), real(0.9999))));
    vec3 base = (vec3(real(1.0)) + root) / (vec3(real(1.0)) - root);
    vec3 inner =
        fresnel_schlick(vec3(normal_reflectance(base.x, index), normal_reflectance(base.y, index),
                             normal_reflectance(base.z, index)),
                        real(1.0), inside);
    // Reflection at a denser medium shifts the phase by half a turn; from below the film's surface,
    // whose inside is the denser, it does not.
    vec3 shift =
        vec3(base.x < index ? real(0.5) : real(0.0), base.y < index ? real(0.5) : real(0.0),
             base.z < index ? real(0.5) : real(0.0)) +
        vec3(real(0.5));
    vec3 both = clamp(inner * outer, vec3(real(1.0e-5)), vec3(real(0.9999)));
    vec3 amplitude = vec3(sqrt(both.x), sqrt(both.y), sqrt(both.z));
    vec3 repeated = inner * passed / (vec3(real(1.0)) - both);
    vec3 sum = vec3(outer) + repeated;
    vec3 order = repeated - vec3(real(1.0) - outer);
    real path = real(2.0) * index * thickness * inside;
    for (uint m = 1u; m <= 2u; ++m) {
        order = order * amplitude;
        sum += order * (real(2.0) * film_sensitivity(real(m) * path, shift * real(m)));
    }
    // The series is cut short, and the colours of the spectrum exceed those of sRGB.
    return clamp(sum, vec3(real(0.0)), vec3(real(1.0)));
}

// No less than the film's reflectance at any wavelength: both reflections in phase. f0: the
// greatest of the surface's channels.
FN real most_film_reflectance(real f0, real film_index, real cosine) {
    real c = clamp(cosine, real(0.0), real(1.0));
    real inside = safe_sqrt(real(1.0) - (real(1.0) - c * c) / (film_index * film_index));
    real outer = fresnel_schlick(vec3(normal_reflectance(film_index, real(1.0))), real(1.0), c).x;
    real root = sqrt(clamp(f0, real(0.0), real(0.9999)));
    real base = (real(1.0) + root) / (real(1.0) - root);
    real inner = fresnel_schlick(vec3(normal_reflectance(base, film_index)), real(1.0), inside).x;
    real a = sqrt(outer), b = sqrt(inner);
    real sum = (a + b) / (real(1.0) + a * b);
    return min(max(sum * sum, outer), real(1.0));
}

ARGAND_SHARED_END

#endif
