#ifndef ARGAND_SHARED_FRESNEL_H
#define ARGAND_SHARED_FRESNEL_H

#include "shared/maths.h"

ARGAND_SHARED_BEGIN

// Share of unpolarised light that a smooth dielectric reflects. cosine: of the incident direction, in (0, 1]; eta: index
// of the far side over that of the near side. cosine_refracted: 0 where all is reflected.
FN real fresnel_dielectric(real cosine, real eta, OUT(real) cosine_refracted) {
    real sine2 = max(real(0.0), real(1.0) - cosine * cosine) / (eta * eta);
    if (sine2 >= real(1.0)) {
        cosine_refracted = real(0.0);
        return real(1.0);
    }
    cosine_refracted = sqrt(real(1.0) - sine2);
    // The denominators are at least eta·cosine > 0.
    real parallel = (eta * cosine - cosine_refracted) / (eta * cosine + cosine_refracted);
    real perpendicular = (cosine - eta * cosine_refracted) / (cosine + eta * cosine_refracted);
    return real(0.5) * (parallel * parallel + perpendicular * perpendicular);
}

// Schlick 1994, between the reflectances at normal and at grazing incidence.
FN vec3 fresnel_schlick(vec3 f0, vec3 f90, real cosine) {
    real x = clamp(real(1.0) - cosine, real(0.0), real(1.0));
    real x2 = x * x;
    return f0 + (f90 - f0) * (x2 * x2 * x);
}

ARGAND_SHARED_END

#endif
