#include "shared/kernels/interleave.h"
#include "shared/kernels/pixel.h"

// The cone of one of a pixel's paths.
FN uint camera_cone(CameraRecord c, vec3 direction) {
    vec3 across = vec3(c.across_x, c.across_y, c.across_z);
    vec3 axis = cross3(across, vec3(c.down_x, c.down_y, c.down_z)); // a pixel's area along the axis
    real area;
    vec3 unit = unit_and_length(axis, area);
    // On the plane at distance 1 a pixel is as large as in the picture; rays to it are longer.
    real width = sqrt(area / real(batch.first_sample + batch.samples));
    real share = real(c.origin_share);
    return pack_cone(width * share, width * (real(1.0) - share) * abs(dot3(unit, direction)));
}

// Starts the paths of a batch.
FN void main() {
    uint slot = THREAD_INDEX;
    if (slot >= batch.pixels * batch.samples) {
        return;
    }
    uint pixel = pixel_in_image(batch.first_pixel + interleave(slot / batch.samples, batch.pixels));
    uint sample_index = batch.first_sample + slot % batch.samples;
    vec4 u = eye_random4(batch.seed, pixel, sample_index, 0u, lattice);
    uint row = pixel / batch.width;
    vec2 in_pixel = vec2(u.x, u.y);
    if (filtered) {
        in_pixel =
            vec2(real(0.5) + blackman_harris_offset(u.x), real(0.5) + blackman_harris_offset(u.y));
    }
    vec3 origin, direction;
    camera_ray(camera[0], real(pixel % batch.width) + in_pixel.x, real(row) + in_pixel.y,
               vec2(u.z, u.w), origin, direction);
    rays[slot] = RayRecord(origin.x, origin.y, origin.z, far_away, direction.x, direction.y,
                           direction.z, cones ? camera_cone(camera[0], direction) : 0u);
    paths[slot] = PathRecord(real(1.0), real(1.0), real(1.0), real(0.0), pixel, sample_index,
                             path_unscaled, 0u);
    layers[slot] = LayersRecord(real(0.0), real(0.0), real(0.0), real(0.0), real(0.0), real(0.0),
                                real(0.0), real(0.0), real(0.0), real(0.0), real(0.0), real(0.0));
    active_slots[slot] = slot;
}
