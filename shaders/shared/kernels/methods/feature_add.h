#include "shared/kernels/interleave.h"
#include "shared/kernels/scene.h"
#include "shared/kernels/textures.h"

#include "shared/kernels/normals.h"

// Adds what the samples of a batch hit first to the sums of their pixels. An invocation adds the
// samples of one pixel in their order. What hits nothing adds nothing.
FN void main() {
    uint i = THREAD_INDEX;
    if (i >= batch.pixels || unfinished[0] > 0u) {
        return;
    }
    uint pixel = batch.first_pixel + interleave(i, batch.pixels);
    FeatureRecord f = features[pixel];
    vec3 albedo = vec3(f.albedo_r, f.albedo_g, f.albedo_b);
    vec3 normal = vec3(f.normal_x, f.normal_y, f.normal_z);
    for (uint s = 0u; s < batch.samples; ++s) {
        uint slot = i * batch.samples + s;
        HitRecord hit = hits[slot];
        if (hit.triangle == no_triangle) {
            continue;
        }
        RayRecord ray = rays[slot];
        vec3 direction = vec3(ray.direction_x, ray.direction_y, ray.direction_z);
        MaterialRecord m = material_at(triangles[hit.triangle], hit, ray.cone, direction);
        albedo += vec3(m.base_r, m.base_g, m.base_b);
        Surface surface = load_surface(hit, direction);
        turn_normal(m.textures, hit, direction, surface);
        normal += surface.shading_normal;
    }
    f.albedo_r = albedo.x;
    f.albedo_g = albedo.y;
    f.albedo_b = albedo.z;
    f.normal_x = normal.x;
    f.normal_y = normal.y;
    f.normal_z = normal.z;
    features[pixel] = f;
}
