#include "shared/kernels/camera_cone.h"
#include "shared/kernels/interleave.h"
#include "shared/kernels/pixel.h"

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
    rays[slot] = RayRecord(
        origin.x, origin.y, origin.z, far_away, direction.x, direction.y, direction.z,
        cones ? camera_cone(camera[0], direction, real(batch.first_sample + batch.samples)) : 0u);
    paths[slot] = PathRecord(real(1.0), real(1.0), real(1.0), real(0.0), pixel, sample_index,
                             path_unscaled, 0u);
    layers[slot] = LayersRecord(real(0.0), real(0.0), real(0.0), real(0.0), real(0.0), real(0.0),
                                real(0.0), real(0.0), real(0.0), real(0.0), real(0.0), real(0.0));
    active_slots[slot] = slot;
    if (weighed) {
        eye_weights[slot] =
            EyeWeightRecord(-density_of_camera_rays(camera[0], direction),
                            camera[0].origin_share > float32(0.0) ? real(0.0) : real(1.0));
    }
}
