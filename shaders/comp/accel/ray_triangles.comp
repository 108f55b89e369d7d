#version 460
layout(local_size_x = 64) in;
#include "kernel.glsl"
#include "shared/accel_records.h"

layout(set = 0, binding = 0) readonly buffer Positions { vec4 positions[]; };
layout(set = 0, binding = 1) readonly buffer Triangles { uvec4 triangles[]; };
layout(set = 0, binding = 2) readonly buffer Order { uint order[]; };
layout(set = 0, binding = 3) writeonly buffer Out { vec4 leaf_triangles[]; };
layout(push_constant) uniform Push { AccelParams params; };

// Copies the triangles' vertices into the order of the leaves.
void main() {
    uint i = THREAD_INDEX;
    if (i >= params.count.number) {
        return;
    }
    uint triangle = order[i];
    uvec3 vertices = triangles[triangle].xyz;
    leaf_triangles[3u * i] = vec4(positions[vertices.x].xyz, uintBitsToFloat(triangle));
    leaf_triangles[3u * i + 1u] = vec4(positions[vertices.y].xyz, 0.0);
    leaf_triangles[3u * i + 2u] = vec4(positions[vertices.z].xyz, 0.0);
}
