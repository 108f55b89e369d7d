#version 460
layout(local_size_x = 64) in;
#include "kernel.glsl"
#include "shared/emissive_records.h"
#include "shared/lights.h"
#include "shared/material_record.h"

layout(set = 0, binding = 0) readonly buffer Parts { EmissivePart parts[]; };
layout(set = 0, binding = 1) readonly buffer Shining { uint shining[]; };
layout(set = 0, binding = 2) readonly buffer Positions { vec4 positions[]; };
layout(set = 0, binding = 3) readonly buffer Triangles { uvec4 triangles[]; };
layout(set = 0, binding = 4) readonly buffer Materials { MaterialRecord materials[]; };
layout(set = 0, binding = 5) writeonly buffer Lights { LightRecord lights[]; };
layout(set = 0, binding = 6) writeonly buffer Sums { EmissiveSum sums[]; };
layout(set = 0, binding = 7) readonly buffer Means { TexelMean means[]; };
layout(push_constant) uniform Push { EmissiveLightParams params; };

// Whether some triangles shine by texels; else `means` is not read.
layout(constant_id = 0) const bool by_texels = false;

#include "shared/kernels/world/emissive_lights.h"
