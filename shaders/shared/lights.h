// Lights sampled from a point, and photons emitted by lights. Units are glTF's: a point light of I
// candela has radiant intensity I.
#ifndef ARGAND_SHARED_LIGHTS_H
#define ARGAND_SHARED_LIGHTS_H

#include "shared/cone.h"
#include "shared/frame.h"
#include "shared/geometry_records.h"
#include "shared/intersect.h"
#include "shared/light_record.h"
#include "shared/scene_records.h"

ARGAND_SHARED_BEGIN

// A direction from a point towards a light.
struct LightSample {
    vec3 wi;
    // The light is visible if this distance is free of obstacles; for surfaces slightly less than
    // the distance of the sampled point.
    real distance;
    // Arriving radiance over the density of the sample; for delta lights the irradiance
    // perpendicular to wi.
    vec3 radiance;
    real pdf;   // solid-angle density; 0 for delta lights
    bool delta; // a delta light (point, spot, directional), which no scattered ray can hit
};

// A photon as a light emits it.
struct EmittedPhoton {
    vec3 origin;    // moved off the emitting surface
    vec3 direction; // unit
    vec3 normal;    // of the emitting surface, on the photon's side; (0,0,0) if there is none
    vec3 flux;      // the light's power, which the photon carries if it is the light's only one
    // Density of photons like this one over that of even emission: of positions across their
    // direction if they come from outside, else of directions.
    real concentration;
    // The part of it that is due to photons aimed at what is in view, and at targets.
    real for_view, for_targets;
};

struct Sphere {
    vec3 center;
    real radius;
};

// Spheres, (center, radius), at which photons from lights inside the scene are aimed.
struct Targets {
    vec4 spheres[most_targets];
    uint count;
    real share; // of the photons, for each sphere
    vec4 view;  // the sphere around what is in view
    real view_share;
};

// Whether the light is of this kind. `kinds` (1u << light_*) are the kinds that the scene has;
// where a kernel knows them at compile time, code for other kinds vanishes.
FN bool is_light(IN(LightRecord) l, uint kinds, uint kind) {
    uint bit = 1u << kind;
    return kinds == bit || ((kinds & bit) != 0u && l.kind == kind);
}

FN vec3 light_color(IN(LightRecord) l) { return vec3(l.r, l.g, l.b); }
FN vec3 light_position(IN(LightRecord) l) { return vec3(l.x, l.y, l.z); }
FN vec3 light_direction(IN(LightRecord) l) { return vec3(l.dx, l.dy, l.dz); }

// Width in cos θ of the ramp of a spot's falloff, which starts at cos_outer. KHR_lights_punctual
// keeps it at least 0.001 wide, so the axis may truncate the ramp of a narrow cone.
FN real spot_ramp(real cos_inner, real cos_outer) {
    return max(cos_inner - cos_outer, real(0.001));
}

// Share of a spot's intensity at this angle from its axis: KHR_lights_punctual, "Inner and Outer
// Cone Angles".
FN real spot_falloff(real cosine, real cos_inner, real cos_outer) {
    real x = clamp((cosine - cos_outer) / spot_ramp(cos_inner, cos_outer), real(0.0), real(1.0));
    return x * x;
}

// Integral of the falloff over directions [sr]. ramp: the part of it that lies on the ramp.
// ramp_share: share of the ramp's width that the axis leaves.
FN real spot_solid_angles(real cos_inner, real cos_outer, OUT(real) ramp, OUT(real) ramp_share) {
    real width = spot_ramp(cos_inner, cos_outer);
    ramp_share = min((real(1.0) - cos_outer) / width, real(1.0));
    ramp = real(2.0) * PI * width * ramp_share * ramp_share * ramp_share / real(3.0);
    return ramp + real(2.0) * PI * max((real(1.0) - cos_outer) - width, real(0.0));
}

// Unit normal of a triangle light's front, and its area; (0,0,0) and 0 if it is degenerate.
FN vec3 light_normal(IN(LightRecord) l, OUT(real) area) {
    vec3 edge1 = vec3(l.dx, l.dy, l.dz) - light_position(l);
    vec3 edge2 = vec3(l.ex, l.ey, l.ez) - light_position(l);
    real length1, length2;
    vec3 unit1 = unit_and_length(edge1, length1);
    vec3 unit2 = unit_and_length(edge2, length2);
    // for now the sine of the angle between the edges
    vec3 n = unit_and_length(cross3(unit1, unit2), area);
    area = real(0.5) * area * length1 * length2;
    return n;
}

FN bool is_double_sided(IN(LightRecord) l) { return (l.triangle_and_sides & 1u) != 0u; }
FN real light_sides(IN(LightRecord) l) { return is_double_sided(l) ? real(2.0) : real(1.0); }
FN uint triangle_of_light(IN(LightRecord) l) { return l.triangle_and_sides >> 1u; }

// Of lights from outside: the sphere before which aimed photons start, on a disc; it contains the
// scene.
FN Sphere aim_sphere(IN(LightRecord) l) {
    Sphere s;
    s.center = light_position(l);
    s.radius = real(l.ex);
    return s;
}

FN bool is_any_sky(IN(LightRecord) l, uint kinds) {
    return is_light(l, kinds, light_sky) || is_light(l, kinds, light_picture);
}

FN bool is_from_outside(IN(LightRecord) l, uint kinds) {
    return is_light(l, kinds, light_directional) || is_any_sky(l, kinds);
}

// Whether the photons of this light come from outside and are aimed by a tree (aim.h).
FN bool is_aimed_from_outside(IN(LightRecord) l, uint kinds) {
    return is_from_outside(l, kinds) && l.triangle_and_sides != 0u;
}

FN uint aim_root(IN(LightRecord) l) { return l.triangle_and_sides; }

// Power that a light sends into a scene with this bounding sphere, from colour (I, E or L) and
// geometry: I times the solid angle, E·pi r², pi L A, 4 pi·pi r²·L.
FN vec3 light_power(IN(LightRecord) l, uint kinds, real radius) {
    real factor = real(0.0);
    if (is_light(l, kinds, light_point)) {
        factor = real(4.0) * PI;
    } else if (is_light(l, kinds, light_spot)) {
        real ramp, ramp_share;
        factor = spot_solid_angles(real(l.cos_inner), real(l.cos_outer), ramp, ramp_share);
    } else if (is_light(l, kinds, light_directional)) {
        factor = PI * radius * radius;
    } else if (is_any_sky(l, kinds)) {
        factor = real(39.478417604357434) * radius * radius; // 4 pi²
    } else if (is_light(l, kinds, light_triangle)) {
        real area;
        light_normal(l, area);
        factor = PI * area * light_sides(l);
    }
    return light_color(l) * factor;
}

// Solid-angle density with which light sampling finds a point on an emissive triangle of this area
// at this distance and cosine (above 0) to its normal. probability: of choosing the triangle.
FN real emitter_density(real probability, real area, real distance, real cosine) {
    return probability / area * distance * distance / cosine;
}

FN bool sample_emitter(IN(LightRecord) l, vec3 p, vec2 u, INOUT(LightSample) s) {
    real area;
    vec3 n = light_normal(l, area);
    vec2 b = sample_triangle(u);
    vec3 error;
    vec3 q = hit_point(light_position(l), vec3(l.dx, l.dy, l.dz), vec3(l.ex, l.ey, l.ez), b.x, b.y,
                       error);
    s.wi = unit_and_length(q - p, s.distance);
    real cosine = -dot3(s.wi, n);
    cosine = is_double_sided(l) ? abs(cosine) : cosine;
    // Edge-on up to rounding: no light arrives.
    if (!(cosine > real(1e-6)) || !(area > real(0.0))) {
        return false;
    }
    real solid_angle = area * cosine / s.distance / s.distance;
    s.radiance = light_color(l) * solid_angle;
    s.pdf = real(1.0) / solid_angle;
    s.delta = false;
    // Rounding errors of both ends and of the intersection with the emitter.
    real slack = (error.x + max_component(abs(p)) * error_bound(16)) / cosine;
    s.distance = max(s.distance - slack, real(0.0)) * (real(1.0) - error_bound(16));
    return is_finite(s.pdf) && s.pdf > real(0.0);
}

// The sky's picture as if all of it came from the direction that was sampled with this density
// [1/sr] and has this radiance.
FN LightRecord light_from_picture(LightRecord l, vec3 towards, vec3 radiance, real pdf) {
    l.dx = float32(-towards.x);
    l.dy = float32(-towards.y);
    l.dz = float32(-towards.z);
    real over_even = pdf * (real(4.0) * PI);
    vec3 color = over_even > real(0.0) ? radiance / over_even : vec3(real(0.0));
    l.r = float32(color.x);
    l.g = float32(color.y);
    l.b = float32(color.z);
    l.ey = float32(over_even);
    return l;
}

// Samples a direction from p towards the light; of a picture it has been sampled before
// (light_from_picture). p must be the origin of the shadow ray: it is
// offset from the surface, and on a large floor the offset exceeds the rounding errors allowed for
// here. Returns false where none of the light arrives.
FN bool light_sample(IN(LightRecord) l, uint kinds, vec3 p, vec2 u, OUT(LightSample) s) {
    s.wi = -light_direction(l);
    s.distance = real(far_away);
    s.radiance = light_color(l);
    s.pdf = real(0.0);
    s.delta = true;
    if (is_light(l, kinds, light_directional)) {
        return true;
    }
    if (is_light(l, kinds, light_sky)) {
        s.wi = sample_sphere(u);
        s.radiance = light_color(l) * (real(4.0) * PI);
        s.pdf = UNIFORM_SPHERE_PDF;
        s.delta = false;
        return true;
    }
    if (is_light(l, kinds, light_picture)) {
        s.radiance = light_color(l) * (real(4.0) * PI);
        s.pdf = real(l.ey) * UNIFORM_SPHERE_PDF;
        s.delta = false;
        return s.pdf > real(0.0);
    }
    if (is_light(l, kinds, light_triangle)) {
        return sample_emitter(l, p, u, s);
    }
    if ((kinds & light_kinds_at_a_point) == 0u) {
        return false;
    }
    s.wi = unit_and_length(light_position(l) - p, s.distance);
    if (!(s.distance > real(0.0))) {
        return false;
    }
    real share = real(1.0);
    if (is_light(l, kinds, light_spot)) {
        share = spot_falloff(-dot3(s.wi, light_direction(l)), real(l.cos_inner), real(l.cos_outer));
    }
    s.radiance = light_color(l) * share / s.distance / s.distance;
    return share > real(0.0) && is_finite3(s.radiance);
}

// Direction of a spot's photon, exactly in proportion to the falloff. On the ramp the falloff is
// the square of the distance from the outer cosine, so that distance is distributed like the
// largest of three uniform numbers.
FN vec3 sample_spot(IN(LightRecord) l, vec4 u, vec2 v) {
    real cos_inner = real(l.cos_inner);
    real cos_outer = real(l.cos_outer);
    real ramp, ramp_share;
    real all = spot_solid_angles(cos_inner, cos_outer, ramp, ramp_share);
    real width = spot_ramp(cos_inner, cos_outer);
    real below = ((real(1.0) - cos_outer) - width) * u.z; // 1 - cos θ, inside the inner cone
    if (u.x * all < ramp) {
        below = (real(1.0) - cos_outer) - max(u.z, max(v.x, v.y)) * ramp_share * width;
    }
    below = clamp(below, real(0.0), real(2.0));
    real s, c;
    sincos_2pi(u.y, s, c);
    real sine = safe_sqrt(below * (real(2.0) - below));
    return to_world(make_frame(light_direction(l)), vec3(sine * c, sine * s, real(1.0) - below));
}

// A photon from a point of the surface, or of the disc on which photons from outside start. error:
// bound of the rounding error of a point on a surface, from which the caller moves the origin.
FN bool emit_evenly(IN(LightRecord) l, uint kinds, IN(Sphere) bounds, vec4 u, vec4 v,
                    OUT(EmittedPhoton) p, OUT(vec3) error) {
    error = vec3(real(0.0));
    p.origin = light_position(l);
    p.direction = light_direction(l);
    p.normal = vec3(real(0.0));
    p.flux = light_power(l, kinds, bounds.radius);
    p.concentration = p.for_view = p.for_targets = real(1.0);
    if (is_light(l, kinds, light_point)) {
        p.direction = sample_sphere(vec2(u.x, u.y));
        return true;
    }
    if (is_light(l, kinds, light_spot)) {
        p.direction = sample_spot(l, u, vec2(u.w, v.x));
        return true;
    }
    if (is_light(l, kinds, light_triangle)) {
        real area;
        vec3 normal = light_normal(l, area);
        p.normal = is_double_sided(l) && v.x < real(0.5) ? -normal : normal;
        p.direction = to_world(make_frame(p.normal), sample_cosine_hemisphere(vec2(u.x, u.y)));
        vec2 b = sample_triangle(vec2(u.z, u.w));
        p.origin =
            hit_point(p.origin, vec3(l.dx, l.dy, l.dz), vec3(l.ex, l.ey, l.ez), b.x, b.y, error);
        return area > real(0.0);
    }
    if ((kinds & light_kinds_from_outside) == 0u) {
        return false;
    }
    if (is_light(l, kinds, light_sky)) {
        p.direction = sample_sphere(vec2(u.x, u.y));
    }
    Frame f = make_frame(p.direction);
    vec2 d = sample_disc(vec2(u.z, u.w));
    p.origin = bounds.center + (f.x * d.x + f.y * d.y - f.z * real(1.001)) * bounds.radius;
    return true;
}

FN void leave_surface(IN(LightRecord) l, uint kinds, vec3 error, INOUT(EmittedPhoton) p) {
    if (is_light(l, kinds, light_triangle)) {
        p.origin = offset_ray_origin(p.origin, error, p.normal, p.direction);
    }
}

// Emits a photon into a scene with these bounds. Returns false if the light emits nothing. Photons
// of directional lights and the sky start on a disc that covers the bounding sphere from outside.
FN bool light_emit(IN(LightRecord) l, uint kinds, IN(Sphere) bounds, vec4 u, vec4 v,
                   OUT(EmittedPhoton) p) {
    vec3 error;
    bool emitted = emit_evenly(l, kinds, bounds, u, v, p, error);
    leave_surface(l, kinds, error, p);
    return emitted;
}

// Solid-angle density of emit_evenly for lights inside the scene. front: normal of a triangle.
FN real emission_density(IN(LightRecord) l, uint kinds, vec3 front, vec3 direction) {
    if (is_light(l, kinds, light_triangle)) {
        real cosine = dot3(front, direction);
        return (is_double_sided(l) ? real(0.5) * abs(cosine) : max(cosine, real(0.0))) * INV_PI;
    }
    if (is_light(l, kinds, light_spot)) {
        real ramp, ramp_share;
        real all = spot_solid_angles(real(l.cos_inner), real(l.cos_outer), ramp, ramp_share);
        return spot_falloff(dot3(direction, light_direction(l)), real(l.cos_inner),
                            real(l.cos_outer)) /
               max(all, real(1e-12));
    }
    return UNIFORM_SPHERE_PDF;
}

// Solid-angle density of photons aimed at a sphere with this share of them all. Photons that start
// in the sphere are not aimed: they keep the density `even`.
FN real aimed_density(vec4 sphere, real share, IN(EmittedPhoton) p, bool is_aimed, real even) {
    Cone c = cone_of(sphere, p.origin);
    if (!(c.height > real(0.0))) {
        return even * share;
    }
    bool inside = is_aimed || is_in_cone(c, p.direction); // the former whatever the rounding
    return inside ? share / cone_solid_angle(c) : real(0.0);
}

// At what a photon is aimed: the index of a target, what is in view, or nothing.
CONSTANT uint at_view = most_targets;
CONSTANT uint at_nothing = most_targets + 1u;

// Sets the concentration of photons with this origin and direction where photons are aimed. even:
// solid-angle density without aiming; aimed: at what the photon is aimed.
FN void concentrate(IN(Targets) targets, real even, uint aimed, INOUT(EmittedPhoton) p) {
    real at_targets = real(targets.count) * targets.share;
    real density = even * (real(1.0) - at_targets - targets.view_share);
    p.for_view = real(1.0);
    if (targets.view_share > real(0.0)) {
        density += aimed_density(targets.view, targets.view_share, p, aimed == at_view, even);
        p.for_view = density / (even * (real(1.0) - at_targets));
    }
    for (uint i = 0u; i < targets.count; ++i) {
        density += aimed_density(targets.spheres[i], targets.share, p, i == aimed, even);
    }
    p.concentration = density / even;
    p.for_targets = p.concentration / p.for_view;
}

// Aims a photon from inside the scene at the targets and at what is in view, in proportion to their
// shares. Returns false if the light does not shine in the direction chosen.
FN bool aim_at_targets(IN(LightRecord) l, uint kinds, IN(Targets) targets, vec2 u, real choice,
                       INOUT(EmittedPhoton) p) {
    real at_targets = real(targets.count) * targets.share;
    uint aimed = choice < at_targets + targets.view_share ? at_view : at_nothing;
    if (choice < at_targets) {
        aimed = min(uint(choice / targets.share), targets.count - 1u);
    }
    real area;
    vec3 front = light_normal(l, area);
    if (aimed != at_nothing) {
        vec4 sphere = targets.view;
        if (aimed != at_view) {
            sphere = targets.spheres[aimed];
        }
        Cone c = cone_of(sphere, p.origin);
        if (c.height > real(0.0)) {
            p.direction = sample_cone(c, u);
            if (is_light(l, kinds, light_triangle)) {
                p.normal =
                    is_double_sided(l) && dot3(front, p.direction) < real(0.0) ? -front : front;
            }
        } else {
            aimed = at_nothing;
        }
    }
    real even = emission_density(l, kinds, front, p.direction);
    concentrate(targets, even, aimed, p);
    return even > real(0.0) && is_finite(p.concentration);
}

// Emits a photon of a directional light or the sky from a disc that suits the tree of aim.h. u: the
// tree's, of this concentration, by which flux is divided. Returns false if the photon starts
// beside the disc that covers the bounding sphere.
FN bool light_emit_from_disc(IN(LightRecord) l, uint kinds, IN(Sphere) bounds, real concentration,
                             vec4 u, vec4 v, OUT(EmittedPhoton) p) {
    vec3 error;
    Sphere around = aim_sphere(l);
    bool emitted = emit_evenly(l, kinds, around, u, v, p, error);
    real ratio = bounds.radius / around.radius;
    p.concentration = concentration * ratio * ratio;
    p.flux = light_power(l, kinds, bounds.radius) / p.concentration;
    vec3 across = p.origin - bounds.center;
    across -= p.direction * dot3(across, p.direction);
    return emitted && dot3(across, across) <= bounds.radius * bounds.radius;
}

// As light_emit, but aims photons from lights inside the scene at the targets. Their flux is
// divided by their concentration (balance heuristic), so that the mean is the same. choice: in
// [0,1), at what to aim.
FN bool light_emit_aimed(IN(LightRecord) l, uint kinds, IN(Sphere) bounds, IN(Targets) targets,
                         vec4 u, vec4 v, real choice, OUT(EmittedPhoton) p) {
    vec3 error;
    bool emitted = emit_evenly(l, kinds, bounds, u, v, p, error);
    if (!is_from_outside(l, kinds) && (targets.count > 0u || targets.view_share > real(0.0)) &&
        emitted) {
        emitted = aim_at_targets(l, kinds, targets, vec2(u.x, u.y), choice, p);
        p.flux = p.flux / (emitted ? p.concentration : real(1.0));
    }
    leave_surface(l, kinds, error, p);
    return emitted;
}

ARGAND_SHARED_END

#endif
