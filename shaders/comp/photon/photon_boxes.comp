#version 460
layout(local_size_x = 64) in;
#include "kernel.glsl"
#include "shared/geometry_records.h"
#include "shared/footprint.h"
#include "shared/photon.h"

layout(set = 0, binding = 0) readonly buffer Photons { PhotonRecord photons[]; };
layout(set = 0, binding = 1) readonly buffer Distances { uint distances[]; };
layout(set = 0, binding = 2) readonly buffer Leaves { uint leaves[]; };
layout(set = 0, binding = 3) readonly buffer Counters { uint counters[]; };
layout(set = 0, binding = 4) writeonly buffer Boxes { BoxRecord boxes[]; };
layout(set = 0, binding = 5) writeonly buffer LeafDistances { uint leaf_distances[]; };

layout(set = 0, binding = 6) readonly buffer Footprints { uvec4 footprints[]; };
layout(push_constant) uniform Push { PhotonBoxParams params; };

// true: boxes around footprints; false: around the photons' positions.
layout(constant_id = 0) const bool around_footprints = false;

#include "shared/kernels/photon/photon_boxes.h"
