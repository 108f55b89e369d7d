#version 460
layout(local_size_x = 64) in;
#include "kernel.glsl"
#include "shared/geometry_records.h"
#include "shared/photon.h"
#include "shared/photon_records.h"
#include "shared/view_points.h"

layout(set = 0, binding = 0) readonly buffer Photons { PhotonRecord photons[]; };
layout(set = 0, binding = 1) readonly buffer Counters { uint counters[]; };
layout(set = 0, binding = 2) readonly buffer ViewPoints { ViewPointRecord view_points[]; };
layout(set = 0, binding = 3) writeonly buffer Rays { RayRecord rays[]; };
layout(set = 0, binding = 4) writeonly buffer Active { uint active_slots[]; };
layout(set = 0, binding = 5) readonly buffer Tested { uint tested_cells[]; };
layout(push_constant) uniform Push { ViewLinkParams params; };

#include "shared/kernels/photon/view_link_rays.h"
