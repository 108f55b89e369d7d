#include "shared/kernels/material.h"
#include "shared/kernels/passes_light.h"

FN void write_texel(uint direction, uint layer, uint triangle, real distance) {
    uint in_map = cube_texels(batch.size);
    uint map = direction / in_map * batch.layers + layer;
    texels[map * in_map + direction % in_map] = uvec2(triangle, float_bits(distance));
}

// Writes the texels of the surfaces that rays have found. Where there are layers, rays go on behind
// what light passes.
FN void main() {
    uint i = THREAD_INDEX;
    if (i >= batch.count || rays[i].t_max < float32(0.0)) {
        return;
    }
    uint at = batch.first + i;
    // The ray carries how many of the surfaces behind it pass light.
    uint passed = rays[i].cone;
    if (passed == 0u) {
        for (uint layer = 0u; layer < batch.layers; ++layer) {
            write_texel(at, layer, no_triangle, far_away);
        }
    }
    HitRecord hit = hits[i];
    if (hit.triangle == no_triangle) {
        rays[i].t_max = -float32(1.0);
        return;
    }
    vec3 direction = vec3(rays[i].direction_x, rays[i].direction_y, rays[i].direction_z);
    vec3 origin = vec3(rays[i].origin_x, rays[i].origin_y, rays[i].origin_z);
    vec3 center = vec3(centers[at / cube_texels(batch.size)]);
    real way = dot3(origin - center, direction) + hit.t;
    if (batch.layers == 1u || !passes_light(load_material(triangles[hit.triangle].w))) {
        write_texel(at, layer_opaque, hit.triangle, way);
        rays[i].t_max = -float32(1.0);
        return;
    }
    if (passed < layer_second) {
        write_texel(at, layer_first + passed, hit.triangle, way);
    }
    vec3 behind = center + direction * (way + real(batch.error));
    rays[i].origin_x = behind.x;
    rays[i].origin_y = behind.y;
    rays[i].origin_z = behind.z;
    rays[i].cone = passed + 1u;
}
