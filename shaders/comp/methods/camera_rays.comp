#version 460
layout(local_size_x = 64) in;
#include "kernel.glsl"
#include "interleave.glsl"
#include "shared/camera.h"
#include "shared/geometry_records.h"
#include "shared/path_records.h"
#include "shared/sampling.h"

layout(set = 0, binding = 0) readonly buffer Cameras { CameraRecord camera[]; };
layout(set = 0, binding = 1) writeonly buffer Rays { RayRecord rays[]; };
layout(set = 0, binding = 2) writeonly buffer Paths { PathRecord paths[]; };
layout(set = 0, binding = 3) writeonly buffer Layers { LayersRecord layers[]; };
layout(set = 0, binding = 4) writeonly buffer Active { uint active_slots[]; };
layout(push_constant) uniform Push { EyeBatch batch; };

void main() {
    uint slot = THREAD_INDEX;
    if (slot >= batch.pixels * batch.samples) {
        return;
    }
    uint pixel = batch.first_pixel + interleave(slot / batch.samples, batch.pixels);
    uint sample_index = batch.first_sample + slot % batch.samples;
    vec4 u = eye_random4(batch.seed, pixel, sample_index, 0u);
    vec3 origin, direction;
    camera_ray(camera[0], float(pixel % batch.width) + u.x, float(pixel / batch.width) + u.y, origin, direction);
    rays[slot] = RayRecord(origin.x, origin.y, origin.z, far_away, direction.x, direction.y, direction.z, 0u);
    paths[slot] = PathRecord(1.0, 1.0, 1.0, 0.0, pixel, sample_index, 0u, 0u);
    layers[slot] = LayersRecord(0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0);
    active_slots[slot] = slot;
}
