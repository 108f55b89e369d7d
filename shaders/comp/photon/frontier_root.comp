#version 460
layout(local_size_x = 64) in;
#include "kernel.glsl"
#include "shared/frontier.h"
#include "shared/photon_records.h"

layout(set = 0, binding = 0) readonly buffer Photons { PhotonRecord photons[]; };
layout(set = 0, binding = 1) readonly buffer Flags { uint flags[]; };
layout(set = 0, binding = 2) readonly buffer Sums { uint sums[]; };
layout(set = 0, binding = 3) writeonly buffer References { uvec4 references[]; };
layout(push_constant) uniform Push { FrontierParams params; };

#include "shared/kernels/photon/frontier_root.h"
