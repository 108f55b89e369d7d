#version 460
layout(local_size_x = 64) in;
#include "kernel.glsl"
#include "shared/accel_records.h"
#include "shared/footprint.h"
#include "shared/photon.h"
#include "shared/photon_records.h"

layout(set = 0, binding = 0) readonly buffer Nodes { uvec4 nodes[]; }; // of an area tree
layout(set = 0, binding = 1) buffer Photons { uvec4 photons[]; };
layout(set = 0, binding = 2) readonly buffer Counters { uint counters[]; };
layout(set = 0, binding = 3) readonly buffer Footprints { uvec4 footprints[]; };
layout(set = 0, binding = 4) readonly buffer WideCaustics { uint wide_caustics[]; };
layout(set = 0, binding = 5) readonly buffer Places { uint places[]; };
layout(push_constant) uniform Push { CoverParams params; };

#define NODES(i) nodes[i]
#define PHOTONS(i) photons[i]

layout(constant_id = 0) const bool uniform_kernel = false;

#include "shared/kernels/photon/caustic_cover.h"
