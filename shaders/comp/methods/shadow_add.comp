#version 460
layout(local_size_x = 64) in;
#include "kernel.glsl"
#include "shared/path_records.h"

layout(set = 0, binding = 0) readonly buffer Active { uint active_slots[]; };
layout(set = 0, binding = 1) readonly buffer Counts { uint counts[]; };
layout(set = 0, binding = 2) readonly buffer Occluded { uint occluded[]; };
layout(set = 0, binding = 3) readonly buffer Shadows { ShadowRecord shadows[]; };
layout(set = 0, binding = 4) buffer Layers { LayersRecord layers[]; };

#include "shared/kernels/methods/shadow_add.h"
