// The scene's buffers, which are the first of every kernel that shades. The kernel's own begin at
// binding 7, and its specialization constants end before 16.
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

// Features of the scene (engine/plan/plan.hpp). Buffers that are not read may be empty.
layout(constant_id = 16) const bool smooth_normals = true;      // false: `normals` is not read
layout(constant_id = 17) const bool several_lights = true;      // false: `light_choices` is not read
layout(constant_id = 18) const uint light_kinds = 63u;          // a bit 1u << light_* for each kind
