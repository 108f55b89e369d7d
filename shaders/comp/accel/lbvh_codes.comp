#version 460
layout(local_size_x = 64) in;
#include "kernel.glsl"
#include "accel/count.glsl"
#include "shared/accel_records.h"

layout(set = 0, binding = 0) readonly buffer Boxes { vec4 boxes[]; };
layout(set = 0, binding = 1) readonly buffer Bounds { vec4 bounds[]; };
layout(set = 0, binding = 2) readonly buffer Counts { uint counts[]; };
layout(set = 0, binding = 3) writeonly buffer Codes { uint codes[]; };
layout(set = 0, binding = 4) writeonly buffer Order { uint order[]; };
layout(push_constant) uniform Push { AccelParams params; };

// Spreads the lowest ten bits to every third place.
uvec3 spread(uvec3 v) {
    v = (v | (v << 16u)) & 0x030000ffu;
    v = (v | (v << 8u)) & 0x0300f00fu;
    v = (v | (v << 4u)) & 0x030c30c3u;
    return (v | (v << 2u)) & 0x09249249u;
}

// The 30-bit Morton code of each box's centre in the bounds of all.
void main() {
    uint i = THREAD_INDEX;
    if (i >= ELEMENT_COUNT) {
        return;
    }
    vec3 low = bounds[0].xyz;
    vec3 extent = bounds[1].xyz - low;
    vec3 centre = 0.5 * boxes[2u * i].xyz + 0.5 * boxes[2u * i + 1u].xyz;
    // A flat extent divides by one; what is beyond single precision's range is clamped.
    vec3 cell = clamp((centre - low) / mix(vec3(1.0), extent, greaterThan(extent, vec3(0.0))) * 1024.0, 0.0, 1023.0);
    uvec3 bits = spread(uvec3(cell));
    codes[i] = (bits.x << 2u) | (bits.y << 1u) | bits.z;
    order[i] = i;
}
