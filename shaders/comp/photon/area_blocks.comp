#version 460
layout(local_size_x = 64) in;
#include "kernel.glsl"
#include "shared/geometry_records.h"
#include "shared/photon.h"
#include "shared/photon_records.h"

layout(set = 0, binding = 0) readonly buffer Photons { PhotonRecord photons[]; };
layout(set = 0, binding = 1) readonly buffer Places { uint places[]; };
layout(set = 0, binding = 2) writeonly buffer Boxes { BoxRecord boxes[]; };
layout(push_constant) uniform Push { AreaBlockParams params; };

#include "shared/kernels/photon/area_blocks.h"
