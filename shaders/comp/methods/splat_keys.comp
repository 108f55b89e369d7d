#version 460
layout(local_size_x = 64) in;
#include "kernel.glsl"
#include "shared/alpha.h"
#include "shared/light_path_records.h"
#include "shared/photon_records.h"

layout(set = 0, binding = 0) readonly buffer Active { uint active_slots[]; };
layout(set = 0, binding = 1) readonly buffer Counters { uint counters[]; };
layout(set = 0, binding = 2) readonly buffer Occluded { uint occluded[]; };
layout(set = 0, binding = 3) readonly buffer Splats { SplatRecord splats[]; };
layout(set = 0, binding = 4) writeonly buffer Keys { uint keys[]; };
layout(set = 0, binding = 5) writeonly buffer Slots { uint slots[]; };
layout(push_constant) uniform Push { SplatParams params; };
// Whether `occluded` tells the thickness of what lets light pass (shared/alpha.h), instead of 0 or 1.
layout(constant_id = 0) const bool has_alpha = true;

#include "shared/kernels/methods/splat_keys.h"
