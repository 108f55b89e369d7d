#version 460
layout(local_size_x = 64) in;
#include "kernel.glsl"
#include "shared/photon.h"

layout(set = 0, binding = 0) readonly buffer Photons { PhotonRecord photons[]; };
layout(set = 0, binding = 1) readonly buffer Counters { uint counters[]; };
layout(set = 0, binding = 2) writeonly buffer Marks { uint marks[]; };
layout(set = 0, binding = 3) writeonly buffer Indices { uint indices[]; };

#include "shared/kernels/photon/area_marks.h"
