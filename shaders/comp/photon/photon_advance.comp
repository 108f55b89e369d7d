#version 460
layout(local_size_x = 1) in;
#include "kernel.glsl"
#include "shared/photon_records.h"

layout(set = 0, binding = 0) buffer Counters { uint counters[]; };
layout(push_constant) uniform Push { PhotonAdvanceParams params; };

#include "shared/kernels/photon/photon_advance.h"
