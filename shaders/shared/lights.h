#ifndef ARGAND_SHARED_LIGHTS_H
#define ARGAND_SHARED_LIGHTS_H

#include "shared/frame.h"
#include "shared/geometry_records.h"
#include "shared/light_record.h"

ARGAND_SHARED_BEGIN

// A direction from a point towards a light.
struct LightSample {
    vec3 wi;
    real distance;      // to the light, a little less where it is a surface
    vec3 radiance;      // arriving, divided by the density of the sample (among samples of this light)
    real pdf;           // solid-angle density; 0 for lights without extent
    bool delta;         // a light without extent: no other way finds it
};

// Where shadow rays end short of an emitter, so that they do not meet it.
CONSTANT real shadow_share = real(0.9999);

FN vec3 light_color(IN(LightRecord) l) { return vec3(l.r, l.g, l.b); }
FN vec3 light_position(IN(LightRecord) l) { return vec3(l.x, l.y, l.z); }
FN vec3 light_direction(IN(LightRecord) l) { return vec3(l.dx, l.dy, l.dz); }

// Share of a spot's intensity at this angle from its axis: KHR_lights_punctual, "Inner and Outer Cone Angles".
FN real spot_falloff(real cosine, real cos_inner, real cos_outer) {
    real x = clamp((cosine - cos_outer) / max(cos_inner - cos_outer, real(0.001)), real(0.0), real(1.0));
    return x * x;
}

// The falloff's integral over all directions [sr].
FN real spot_solid_angle(real cos_inner, real cos_outer) {
    // Where the ramp is cut short by the least width of 0.001, it would end at a cosine above the inner one's.
    real full = cos_outer + max(cos_inner - cos_outer, real(0.001));
    real top = min(full, real(1.0));
    real share = (top - cos_outer) / (full - cos_outer);
    return real(2.0) * PI * ((full - cos_outer) * share * share * share / real(3.0) + (real(1.0) - top));
}

// A uniform point's weights of the second and third vertex of a triangle.
FN vec2 sample_triangle(vec2 u) {
    real root = sqrt(u.x);
    return vec2(root * (real(1.0) - u.y), root * u.y);
}

// Edges' cross product: along the normal, twice the area long.
FN vec3 light_cross(IN(LightRecord) l) {
    return cross(vec3(l.dx, l.dy, l.dz) - light_position(l), vec3(l.ex, l.ey, l.ez) - light_position(l));
}

FN vec3 triangle_point(IN(LightRecord) l, vec2 u) {
    vec2 b = sample_triangle(u);
    return light_position(l) * (real(1.0) - b.x - b.y) + vec3(l.dx, l.dy, l.dz) * b.x + vec3(l.ex, l.ey, l.ez) * b.y;
}

// Power that a light sends into a scene with this bounding sphere: I times solid angle, E·πr², πLA, 4π·πr²·L.
FN vec3 light_power(IN(LightRecord) l, real radius) {
    if (l.kind == light_point) {
        return light_color(l) * (real(4.0) * PI);
    }
    if (l.kind == light_spot) {
        return light_color(l) * spot_solid_angle(real(l.cos_inner), real(l.cos_outer));
    }
    if (l.kind == light_directional) {
        return light_color(l) * (PI * radius * radius);
    }
    if (l.kind == light_sky) {
        return light_color(l) * (real(4.0) * PI * PI * radius * radius);
    }
    vec3 c = light_cross(l);
    real area = real(0.5) * sqrt(dot(c, c));
    return light_color(l) * (PI * area * (l.double_sided != 0u ? real(2.0) : real(1.0)));
}

// Lights are chosen in proportion to their mean power over the channels; this is an emissive triangle's per area and
// side, which gives its density where a ray has hit it.
FN real light_weight_of_emitter(vec3 radiance) { return PI * mean_component(radiance); }

// Samples a direction from p towards the light. False where none of its light arrives.
FN bool light_sample(IN(LightRecord) l, vec3 p, vec2 u, OUT(LightSample) s) {
    s.delta = true;
    s.pdf = real(0.0);
    s.distance = real(far_away);
    s.radiance = light_color(l);
    s.wi = -light_direction(l);
    if (l.kind == light_directional) {
        return true;
    }
    if (l.kind == light_sky) {
        s.wi = sample_sphere(u);
        s.delta = false;
        s.pdf = real(0.25) * INV_PI;
        s.radiance = light_color(l) * (real(4.0) * PI);
        return true;
    }
    vec3 q = l.kind == light_triangle ? triangle_point(l, u) : light_position(l);
    vec3 d = q - p;
    real largest = max(abs(d.x), max(abs(d.y), abs(d.z)));
    if (!(largest > real(0.0))) {
        return false;
    }
    // Scaled by the largest component, so that squares neither over- nor underflow.
    vec3 scaled = d / largest;
    real length_scaled = sqrt(dot(scaled, scaled));
    s.wi = scaled / length_scaled;
    s.distance = length_scaled * largest;
    if (l.kind != light_triangle) {
        real falloff = l.kind == light_spot
            ? spot_falloff(-dot(s.wi, light_direction(l)), real(l.cos_inner), real(l.cos_outer)) : real(1.0);
        s.radiance = light_color(l) * falloff / s.distance / s.distance;
        return falloff > real(0.0);
    }
    vec3 c = light_cross(l);
    real twice_area = sqrt(dot(c, c));
    real cosine = -dot(s.wi, c) / max(twice_area, real(1e-37));
    if (cosine < real(0.0) && l.double_sided != 0u) {
        cosine = -cosine;
    }
    if (!(cosine > real(1e-7)) || !(twice_area > real(0.0))) {
        return false;
    }
    s.delta = false;
    real inverse_pdf = real(0.5) * twice_area * cosine / s.distance / s.distance;
    s.pdf = real(1.0) / max(inverse_pdf, real(1e-37));
    s.radiance = light_color(l) * inverse_pdf;
    s.distance *= shadow_share;
    return true;
}

// Emits a photon. flux: what it carries if it is the light's only one. normal: of the emitting surface on the photon's
// side, (0,0,0) if it does not start on one. Directional light and the sky start on a disc that covers the scene.
FN bool light_emit(IN(LightRecord) l, vec4 u, vec4 v, vec3 center, real radius, OUT(vec3) origin, OUT(vec3) direction,
                   OUT(vec3) normal, OUT(vec3) flux) {
    normal = vec3(real(0.0));
    origin = light_position(l);
    direction = light_direction(l);
    flux = light_power(l, radius);
    if (l.kind == light_point) {
        direction = sample_sphere(vec2(u.x, u.y));
        return true;
    }
    if (l.kind == light_spot) {
        // The falloff x² over its ramp, and 1 over the cap within: both inverted exactly.
        real cos_outer = real(l.cos_outer);
        real full = cos_outer + max(real(l.cos_inner) - cos_outer, real(0.001));
        real top = min(full, real(1.0));
        real share = (top - cos_outer) / (full - cos_outer);
        real ramp = (full - cos_outer) * share * share * share / real(3.0);
        real cap = real(1.0) - top;
        real chosen = u.x * (ramp + cap);
        real cosine = top + (chosen - ramp);
        if (chosen < ramp) {
            // Cube root of chosen / ramp in [0, 1): by Newton's method from above, for pow differs between drivers.
            real target = chosen / ramp;
            real root = real(1.0);
            for (int i = 0; i < 24; ++i) {
                root = root - (root * root * root - target) / (real(3.0) * max(root * root, real(1e-20)));
            }
            cosine = cos_outer + (top - cos_outer) * max(root, real(0.0));
        }
        cosine = min(cosine, real(1.0));
        real s, c;
        sincos_2pi(u.y, s, c);
        real sine = safe_sqrt((real(1.0) - cosine) * (real(1.0) + cosine));
        direction = to_world(make_frame(light_direction(l)), vec3(sine * c, sine * s, cosine));
        return true;
    }
    if (l.kind == light_directional || l.kind == light_sky) {
        if (l.kind == light_sky) {
            direction = sample_sphere(vec2(u.x, u.y));
        }
        Frame f = make_frame(direction);
        vec2 d = sample_disc(vec2(u.z, u.w));
        origin = center + (f.x * d.x + f.y * d.y - f.z) * radius;
        return true;
    }
    origin = triangle_point(l, vec2(u.z, u.w));
    vec3 c = light_cross(l);
    real length_c = sqrt(dot(c, c));
    if (!(length_c > real(0.0))) {
        return false;
    }
    normal = c / length_c;
    if (l.double_sided != 0u && v.x < real(0.5)) {
        normal = -normal;
    }
    vec3 local = sample_cosine_hemisphere(vec2(u.x, u.y));
    direction = to_world(make_frame(normal), local);
    return local.z > real(0.0);
}

ARGAND_SHARED_END

#endif
