#version 460
layout(local_size_x = 64) in;
#include "kernel.glsl"
#include "shared/photon.h"

layout(set = 0, binding = 0) readonly buffer Codes { uint codes[]; };
layout(set = 0, binding = 1) buffer Counters { uint counters[]; };

layout(constant_id = 0) const bool codes64 = false;  // codes of 64 bits; else of 32

#include "shared/kernels/photon/photon_count.h"
