#version 460
layout(local_size_x = 64) in;
#include "kernel.glsl"
#include "shared/geometry_records.h"
#include "shared/photon_records.h"
#include "shared/queue_records.h"

layout(set = 0, binding = 0) readonly buffer Boxes { uint boxes[]; };
layout(set = 0, binding = 1) readonly buffer Starts { uint starts[]; };
layout(set = 0, binding = 2) readonly buffer Emptied { uint emptied[]; };
layout(set = 0, binding = 3) readonly buffer Blocks { QueueBlock blocks[]; };
layout(set = 0, binding = 4) writeonly buffer Leaves { uint leaves[]; };
layout(set = 0, binding = 5) writeonly buffer More { uint more[]; };
layout(set = 0, binding = 6) writeonly buffer Crowded { uint crowded[]; };
layout(set = 0, binding = 7) writeonly buffer LeafBoxes { BoxRecord leaf_boxes[]; };
layout(set = 0, binding = 8) writeonly buffer Scales { float scales[]; };
layout(push_constant) uniform Push { QueueParams params; };

#include "shared/kernels/photon/queue_leaves.h"
