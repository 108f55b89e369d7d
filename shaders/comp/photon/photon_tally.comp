#version 460
layout(local_size_x = 64) in;
#include "kernel.glsl"
#include "shared/photon.h"

layout(set = 0, binding = 0) readonly buffer Photons { PhotonRecord photons[]; };
layout(set = 0, binding = 1) buffer Counters { uint counters[]; };

#include "shared/kernels/photon/photon_tally.h"
