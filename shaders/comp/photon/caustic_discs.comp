#version 460
layout(local_size_x = 64) in;
#include "kernel.glsl"
#include "shared/accel_records.h"
#include "shared/nearest_records.h"
#include "shared/photon.h"
#include "shared/photon_records.h"
#include "shared/query_record.h"

layout(set = 0, binding = 0) readonly buffer Nodes { uvec4 nodes[]; }; // of an area tree
layout(set = 0, binding = 1) readonly buffer Places { uint places[]; };
layout(set = 0, binding = 2) readonly buffer Photons { uvec4 photons[]; };
layout(set = 0, binding = 3) readonly buffer Active { uint active_slots[]; };
layout(set = 0, binding = 4) readonly buffer Counts { uint counts[]; };
layout(set = 0, binding = 5) readonly buffer Queries { QueryRecord queries[]; };
layout(set = 0, binding = 6) readonly buffer SquaredRadii { float squared_radii[]; };
layout(set = 0, binding = 7) buffer Estimates { EstimateRecord estimates[]; };
layout(push_constant) uniform Push { CoverParams params; };

#define NODES(i) nodes[i]
#define PHOTONS(i) photons[i]

layout(constant_id = 0) const bool uniform_kernel = false;

#include "shared/kernels/photon/caustic_discs.h"
