#version 460
layout(local_size_x = 64) in;
#include "kernel.glsl"
#include "material_features.glsl"
#include "shared/bsdf.h"
#include "shared/cube_map.h"
#include "shared/image_space_records.h"
#include "shared/texture_record.h"

layout(set = 0, binding = 0) readonly buffer Triangles { uvec4 triangles[]; };
layout(set = 0, binding = 1) readonly buffer Materials { MaterialRecord materials[]; };
layout(set = 0, binding = 2) readonly buffer Centers { vec4 centers[]; };
layout(set = 0, binding = 3) readonly buffer Hits { HitRecord hits[]; };
layout(set = 0, binding = 4) buffer Rays { RayRecord rays[]; };
layout(set = 0, binding = 5) writeonly buffer Texels { uvec2 texels[]; };
layout(push_constant) uniform Push { CubeBatch batch; };

#include "shared/kernels/imagespace/cube_write.h"
