// The scene's buffers, at the first binding numbers of every kernel that shades; a kernel's own begin at
// FIRST_OWN_BINDING (9).
#include "shared/geometry_records.h"
#include "shared/light_record.h"
#include "shared/material_record.h"
#include "shared/scene_records.h"
#include "shared/surface.h"

layout(set = 0, binding = 0) readonly buffer SceneBlock { SceneRecord scene[]; };
layout(set = 0, binding = 1) readonly buffer Positions { vec4 positions[]; };
layout(set = 0, binding = 2) readonly buffer Normals { vec4 normals[]; };
layout(set = 0, binding = 3) readonly buffer Triangles { uvec4 triangles[]; };
layout(set = 0, binding = 4) readonly buffer Materials { MaterialRecord materials[]; };
layout(set = 0, binding = 5) readonly buffer Lights { LightRecord lights[]; };
layout(set = 0, binding = 6) readonly buffer LightChoices { LightChoice light_choices[]; };

vec3 scene_center() { return vec3(scene[0].center_x, scene[0].center_y, scene[0].center_z); }

Surface load_surface(HitRecord hit, vec3 ray_direction) {
    uvec4 t = triangles[hit.triangle];
    return make_surface(positions[t.x].xyz, positions[t.y].xyz, positions[t.z].xyz, normals[t.x].xyz, normals[t.y].xyz,
                        normals[t.z].xyz, hit.u, hit.v, ray_direction);
}

// Index of a light chosen in proportion to its weight (Walker 1977); u in [0,1).
uint choose_light(float u, out float probability) {
    float scaled = u * float(scene[0].light_count);
    uint row = min(uint(scaled), scene[0].light_count - 1u);
    LightChoice choice = light_choices[row];
    if (scaled - float(row) >= choice.keep) {
        row = choice.alias;
    }
    probability = light_choices[row].probability;
    return row;
}
