#version 460
layout(local_size_x = 64) in;
#include "kernel.glsl"
#include "shared/photon.h"

layout(set = 0, binding = 0) readonly buffer Photons { PhotonRecord photons[]; };
layout(set = 0, binding = 1) readonly buffer Order { uint order[]; };
layout(set = 0, binding = 2) readonly buffer Counters { uint counters[]; };
layout(set = 0, binding = 3) writeonly buffer Sorted { PhotonRecord sorted[]; };

#include "shared/kernels/photon/photon_order.h"
