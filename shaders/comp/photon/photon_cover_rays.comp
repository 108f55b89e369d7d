#version 460
layout(local_size_x = 64) in;
#include "kernel.glsl"
#include "shared/cover_records.h"
#include "shared/geometry_records.h"
#include "shared/photon.h"

layout(set = 0, binding = 0) readonly buffer Photons { PhotonRecord photons[]; };
layout(set = 0, binding = 1) writeonly buffer Rays { RayRecord rays[]; };
layout(set = 0, binding = 2) writeonly buffer Active { uint active_slots[]; };
layout(push_constant) uniform Push { PhotonCoverParams params; };

#include "shared/kernels/photon/photon_cover_rays.h"
