#version 460
layout(local_size_x = 64) in;
#include "kernel.glsl"
#include "shared/alpha.h"
#include "shared/path_records.h"

layout(set = 0, binding = 0) readonly buffer Active { uint active_slots[]; };
layout(set = 0, binding = 1) readonly buffer Counts { uint counts[]; };
layout(set = 0, binding = 2) readonly buffer Occluded { uint occluded[]; };
layout(set = 0, binding = 3) readonly buffer Shadows { ShadowRecord shadows[]; };
layout(set = 0, binding = 4) buffer Layers { LayersRecord layers[]; };
// Whether `occluded` tells the thickness of what lets light pass (shared/alpha.h), instead of 0 or 1.
layout(constant_id = 0) const bool has_alpha = true;

#include "shared/kernels/methods/shadow_add.h"
