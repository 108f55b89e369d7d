// Differentials of the photons that light_emit emits. Derivations: docs/methods/footprints.md.
#ifndef ARGAND_SHARED_LIGHT_DIFFERENTIAL_H
#define ARGAND_SHARED_LIGHT_DIFFERENTIAL_H

#include "shared/differential.h"
#include "shared/lights.h"

ARGAND_SHARED_BEGIN

// Differential of a photon at its emission by light_emit. radius: of the scene's bounding sphere.
// photons: expected from this light in the pass, that is all photons times the light's probability.
// emitter_photons: expected from all triangles of the same emitter together, so that dividing an
// emitter into many triangles does not widen its differentials; used by triangle lights only.
FN PhotonDifferential light_differential(IN(LightRecord) l, uint kinds, IN(EmittedPhoton) p,
                                         real radius, real photons, real emitter_photons) {
    vec3 direction = p.direction;
    PhotonDifferential d = no_differential();
    if (is_light(l, kinds, light_point) || is_light(l, kinds, light_spot)) {
        Frame f;
        f.x = vec3(real(1.0), real(0.0), real(0.0));
        f.y = vec3(real(0.0), real(1.0), real(0.0));
        f.z = vec3(real(0.0), real(0.0), real(1.0));
        real density = UNIFORM_SPHERE_PDF;
        if (is_light(l, kinds, light_spot)) {
            f = make_frame(light_direction(l));
            real cos_inner = real(l.cos_inner);
            real cos_outer = real(l.cos_outer);
            real ramp, ramp_share;
            real all = spot_solid_angles(cos_inner, cos_outer, ramp, ramp_share);
            // At most the whole cone, although its rim is dark.
            real least = real(1.0) / max(photons, real(1.0));
            density = max(spot_falloff(dot3(direction, f.z), cos_inner, cos_outer), least) /
                      max(all, real(1e-12));
        }
        real spread = photon_spacing(photons * p.concentration, density);
        vec3 axis_u, axis_v;
        direction_axes(f, direction, axis_u, axis_v);
        d.dd_du = axis_u * spread;
        d.dd_dv = axis_v * spread;
        return d;
    }
    Frame f = make_frame(direction);
    // Distance of photons on the disc on which they start.
    real side = radius * sqrt(PI / max(photons * p.concentration, real(1.0)));
    real spread = real(0.0);
    if (is_light(l, kinds, light_sky)) {
        spread = sqrt(PI / max(photons * p.concentration, real(1.0)));
    } else if (is_light(l, kinds, light_picture)) {
        spread = sqrt(PI / max(photons * p.concentration * real(l.ey), real(1.0)));
    } else if (is_light(l, kinds, light_triangle)) {
        real area;
        light_normal(l, area);
        real cosine = max(abs(dot3(direction, p.normal)), SMALLEST_EMISSION_COSINE);
        real sides = light_sides(l);
        side = sqrt(area * sides * cosine / max(photons, real(1.0)));
        spread = sqrt(sides) * photon_spacing(emitter_photons * p.concentration, cosine * INV_PI);
    }
    d.dp_du = f.x * side;
    d.dp_dv = f.y * side;
    add_independent_spread(d, direction, spread);
    return d;
}

ARGAND_SHARED_END

#endif
