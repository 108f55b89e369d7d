#version 460
layout(local_size_x = 64) in;
#include "kernel.glsl"
#include "shared/emissive_records.h"
#include "shared/lights.h"

layout(set = 0, binding = 0) readonly buffer Rows { LightChoice rows[]; }; // and one behind the last
layout(set = 0, binding = 1) readonly buffer Parts { EmissivePart parts[]; };
layout(set = 0, binding = 2) readonly buffer Lights { LightRecord lights[]; };
layout(set = 0, binding = 3) writeonly buffer LightChoices { LightChoice light_choices[]; };
layout(push_constant) uniform Push { EmissiveChoiceParams params; };

#include "shared/kernels/world/emissive_choices.h"
