// Weights of multiple importance sampling (Veach and Guibas 1995) for three ways to find one path
// from a light to the eye: an eye path is scattered onto the light, its last vertex sends a shadow
// ray there, or a light path is connected with the eye from its last vertex. Each way counts by the
// square of its density over the sum of all squares.
//
// Eye and light path must compute the same weights from the same path, each from its end. As in
// Georgiev et al. 2012 ("Light Transport Simulation with Vertex Connection and Merging", appendix
// A), what the densities have in common cancels. Measured in projected solid angle, smooth and
// Lambertian surfaces scatter from the eye to the light as densely as from the light to the eye,
// others roughly so: the vertices between the first and the last one are taken to cancel as well.
// That moves weights from one way to another, but never their sum from 1.
//
// What remains is the density of eye paths at the first vertex z1 and in its scattering, that of
// photons at the last vertex zn, and that of shadow rays there.
#ifndef ARGAND_SHARED_LIGHT_PATH_H
#define ARGAND_SHARED_LIGHT_PATH_H

#include "shared/camera.h"
#include "shared/lights.h"

ARGAND_SHARED_BEGIN

// Where the eye sees a point from, and where in the picture.
struct EyeConnection {
    vec3 direction; // unit, from the eye to the point
    real distance;
    real x, y;    // pixels from the image's top left corner
    real density; // of samples of the pixels per area across `direction`, one for each pixel
};

// The camera's axis, and the area of a pixel on the plane at distance 1 (orthographic: of a pixel
// in the scene).
FN vec3 camera_axis(IN(CameraRecord) c, OUT(real) pixel_area) {
    vec3 across = vec3(c.across_x, c.across_y, c.across_z);
    vec3 axis = unit_and_length(cross3(across, vec3(c.down_x, c.down_y, c.down_z)), pixel_area);
    vec3 forward = vec3(c.forward_x, c.forward_y, c.forward_z);
    return dot3(axis, forward) < real(0.0) ? -axis : axis;
}

// Density of samples per solid angle of a perspective camera's rays, one for each pixel;
// orthographic: per area across them.
FN real density_of_camera_rays(IN(CameraRecord) c, vec3 direction) {
    real pixel_area;
    vec3 axis = camera_axis(c, pixel_area);
    real cosine = dot3(direction, axis);
    real squared = c.origin_share > float32(0.0) ? real(1.0) : cosine * cosine;
    return real(1.0) / (pixel_area * cosine * squared);
}

// Connects the eye with a point through the point of the lens that `on_lens` in [0, 1)² stands for.
// Returns false if the point lies behind the eye.
FN bool connect_eye(IN(CameraRecord) c, vec3 point, vec2 on_lens, OUT(EyeConnection) e) {
    vec3 across = vec3(c.across_x, c.across_y, c.across_z);
    vec3 down = vec3(c.down_x, c.down_y, c.down_z);
    real pixel_area;
    vec3 axis = camera_axis(c, pixel_area);
    vec3 forward = vec3(c.forward_x, c.forward_y, c.forward_z);
    vec3 offset = vec3(real(0.0));
    if (c.lens_radius > float32(0.0)) {
        vec2 d = sample_disc(on_lens) * real(c.lens_radius);
        offset =
            across * (d.x / sqrt(dot3(across, across))) + down * (d.y / sqrt(dot3(down, down)));
    }
    vec3 to_point = point - (vec3(c.origin_x, c.origin_y, c.origin_z) + offset);
    real depth = dot3(to_point, axis);
    vec3 bent = offset * real(c.inverse_focus); // by the lens, at distance 1
    bool parallel = c.origin_share > float32(0.0);
    vec3 along = parallel ? forward - bent : to_point;
    e.direction = unit_and_length(along, e.distance);
    e.distance = parallel ? depth * e.distance : e.distance;
    e.density = density_of_camera_rays(c, e.direction);
    if (!parallel) {
        e.density = e.density / e.distance / e.distance;
    }
    vec3 in_picture = parallel ? to_point - along * depth : to_point / depth + bent - forward;
    e.x = dot3(in_picture, across) / dot3(across, across);
    e.y = dot3(in_picture, down) / dot3(down, down);
    return depth > real(0.0) && e.distance > real(0.0) && is_finite(e.density);
}

// 1 over the density of eye paths that are scattered at the first vertex, for one sample of each
// pixel. density: EyeConnection::density there; cosine: of their direction to the normal; pdf: of
// the scattered direction, over its cosine to the shading normal.
FN real scarcity_of_eye_paths(real density, real cosine, real pdf) {
    return min(real(1.0) / (density * abs(cosine) * pdf), real(1.0e30));
}

// Density of photons that a light sends from `origin` along `direction`: per area across the
// direction and per solid angle, or for delta lights per area, at `distance`. photons: of this
// light; sky_pdf: density with which the sky's direction is sampled. Photons from outside, which
// are aimed by a tree, count as even over the disc on which they start.
FN real density_of_photons(IN(LightRecord) l, uint kinds, IN(Targets) targets, real scene_radius,
                           real photons, vec3 origin, vec3 direction, real distance, real sky_pdf) {
    if (is_from_outside(l, kinds)) {
        real radius = is_aimed_from_outside(l, kinds) ? aim_sphere(l).radius : scene_radius;
        real per_area = photons / PI / radius / radius;
        return is_light(l, kinds, light_directional) ? per_area : per_area * sky_pdf;
    }
    real area;
    vec3 front = light_normal(l, area);
    EmittedPhoton p;
    p.origin = origin;
    p.direction = direction;
    real even = emission_density(l, kinds, front, direction);
    concentrate(targets, even, at_nothing, p);
    photons = even > real(0.0) ? photons * p.concentration : real(0.0);
    if (is_light(l, kinds, light_triangle)) {
        return photons * INV_PI / (area * light_sides(l));
    }
    return photons * even / distance / distance;
}

// The share of light paths in what all three ways find. Densities in one unit: of a light path, of
// a shadow ray and of a scattered eye path.
FN real share_of_light_paths(real by_light_path, real by_shadow_ray, real by_scattering) {
    if (!(by_light_path > real(0.0))) {
        return real(0.0);
    }
    real a = by_shadow_ray / by_light_path;
    real b = by_scattering / by_light_path;
    return real(1.0) / (real(1.0) + a * a + b * b);
}

ARGAND_SHARED_END

#endif
