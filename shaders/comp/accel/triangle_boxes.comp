#version 460
layout(local_size_x = 64) in;
#include "kernel.glsl"
#include "shared/accel_records.h"
#include "shared/geometry_records.h"

layout(set = 0, binding = 0) readonly buffer Positions { vec4 positions[]; };
layout(set = 0, binding = 1) readonly buffer Triangles { uvec4 triangles[]; };
layout(set = 0, binding = 2) writeonly buffer Boxes { vec4 boxes[]; };
layout(push_constant) uniform Push { AccelParams params; };

// The bounding box of each triangle.
void main() {
    uint i = THREAD_INDEX;
    if (i >= params.count.number) {
        return;
    }
    uvec3 vertices = triangles[i].xyz;
    vec3 a = positions[vertices.x].xyz;
    vec3 b = positions[vertices.y].xyz;
    vec3 c = positions[vertices.z].xyz;
    boxes[2u * i] = vec4(min(min(a, b), c), 0.0);
    boxes[2u * i + 1u] = vec4(max(max(a, b), c), 0.0);
}
