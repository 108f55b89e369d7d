// Makes lights of a part of the emissive triangles, where their vertices are now, and sums their
// power.
#include "shared/emissive.h"

FN void main() {
    uint i = THREAD_INDEX;
    if (i >= params.parts) {
        return;
    }
    EmissivePart part = parts[i];
    vec3 power = vec3(real(0.0));
    vec3 rest = vec3(real(0.0)); // of `power`
    vec3 middle = vec3(real(0.0));
    real weight = real(0.0); // of `middle`
    for (uint k = part.first; k < part.first + part.count; ++k) {
        uvec4 t = triangles[shining[k]];
        vec3 a = vec3(positions[t.x]);
        vec3 b = vec3(positions[t.y]);
        vec3 c = vec3(positions[t.z]);
        LightRecord light = emissive_light(shining[k], a, b, c, materials[t.w]);
        if (by_texels) {
            shine_by_texels(light, means[k]);
        }
        lights[params.first_light + k] = light;
        vec3 p = light_power(light, 1u << light_triangle, real(0.0));
        add_without_loss(power.x, rest.x, p.x);
        add_without_loss(power.y, rest.y, p.y);
        add_without_loss(power.z, rest.z, p.z);
        real by = p.x + p.y + p.z;
        middle += (a + b + c) * by;
        weight += real(3.0) * by;
    }
    power += rest;
    middle = weight > real(0.0) ? middle / weight : middle;
    EmissiveSum sum;
    sum.power_r = power.x;
    sum.power_g = power.y;
    sum.power_b = power.z;
    sum.pad0 = real(0.0);
    sum.middle_x = middle.x;
    sum.middle_y = middle.y;
    sum.middle_z = middle.z;
    sum.pad1 = real(0.0);
    sums[i] = sum;
}
