#version 460
layout(local_size_x = 64) in;
#include "kernel.glsl"
#include "shared/cube_map.h"
#include "shared/image_space_records.h"

layout(set = 0, binding = 0) readonly buffer Centers { vec4 centers[]; };
layout(set = 0, binding = 1) writeonly buffer Rays { RayRecord rays[]; };
layout(set = 0, binding = 2) writeonly buffer Active { uint active_rays[]; };
layout(push_constant) uniform Push { CubeBatch batch; };

#include "shared/kernels/imagespace/cube_rays.h"
