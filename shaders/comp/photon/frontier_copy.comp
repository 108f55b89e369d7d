#version 460
layout(local_size_x = 64) in;
#include "kernel.glsl"
#include "shared/frontier.h"

layout(set = 0, binding = 0) readonly buffer References { uvec4 references[]; };
layout(set = 0, binding = 1) readonly buffer Sources { uint sources[]; };
layout(set = 0, binding = 2) readonly buffer FirstChunks { uint first_chunks[]; };
layout(set = 0, binding = 3) readonly buffer Nodes { FrontierNode nodes[]; };
layout(set = 0, binding = 4) readonly buffer Families { uint families[]; };
layout(set = 0, binding = 5) readonly buffer Boxes { BoxRecord boxes[]; };
layout(set = 0, binding = 6) readonly buffer Extents { vec4 extents[]; };
layout(set = 0, binding = 7) readonly buffer Places { uint places[]; };
layout(set = 0, binding = 8) writeonly buffer NextReferences { uvec4 next_references[]; };
layout(push_constant) uniform Push { FrontierParams params; };
layout(constant_id = 0) const bool of_footprints = false;

#include "shared/kernels/photon/frontier_copy.h"
