#ifndef ARGAND_SHARED_FRESNEL_H
#define ARGAND_SHARED_FRESNEL_H

#include "shared/maths.h"

ARGAND_SHARED_BEGIN

// Reflectance of the smooth interface of two dielectrics for unpolarised light. cosine: of the
// incident direction, in [0, 1]. eta > 0: refractive index of the far side over that of the near
// side. cosine_refracted: by Snell's law; 0 under total reflection.
FN real fresnel_dielectric(real cosine, real eta, OUT(real) cosine_refracted) {
    // eta² - sin², written so that an index of 1 leaves grazing rays unchanged.
    real k = (eta - real(1.0)) * (eta + real(1.0)) + cosine * cosine;
    if (!(k > real(0.0))) {
        cosine_refracted = real(0.0);
        return real(1.0);
    }
    real root = sqrt(k);
    cosine_refracted = min(root / eta, real(1.0));
    // Both denominators are positive because root is.
    real perpendicular = (cosine - root) / (cosine + root);
    real parallel = (eta * cosine - cosine_refracted) / (eta * cosine + cosine_refracted);
    return real(0.5) * (perpendicular * perpendicular + parallel * parallel);
}

// Schlick's approximation (1994) between the reflectances at normal and at grazing incidence.
FN vec3 fresnel_schlick(vec3 f0, real f90, real cosine) {
    real x = clamp(real(1.0) - cosine, real(0.0), real(1.0));
    real x2 = x * x;
    return f0 + (vec3(f90) - f0) * (x2 * x2 * x);
}

ARGAND_SHARED_END

#endif
