#version 460
layout(local_size_x = 64) in;
#include "kernel.glsl"
#include "shared/morton.h"
#include "shared/photon.h"

layout(set = 0, binding = 0) readonly buffer Bounds { vec4 bounds[]; };
layout(set = 0, binding = 1) readonly buffer Counters { uint counters[]; };
layout(set = 0, binding = 2) readonly buffer Photons { PhotonRecord photons[]; };
layout(set = 0, binding = 3) writeonly buffer Codes { uint codes[]; };
layout(set = 0, binding = 4) writeonly buffer Order { uint order[]; };

layout(constant_id = 0) const bool codes64 = false;  // codes of 64 bits, low word first; else of 32

#include "shared/kernels/photon/photon_codes.h"
