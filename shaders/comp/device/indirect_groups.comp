#version 460
layout(local_size_x = 1) in;
#include "kernel.glsl"
#include "shared/device_records.h"

layout(set = 0, binding = 0) readonly buffer Counts { uint counts[]; };
layout(set = 0, binding = 1) writeonly buffer Groups { uvec4 groups[]; };
layout(push_constant) uniform Push { IndirectGroupsParams params; };

// As VulkanDevice::dispatch: a count beyond the limit of one dimension spills into the next.
void main() {
    uint count = counts[params.count_index];
    uint needed = count / params.group_size + (count % params.group_size > 0u ? 1u : 0u);
    uint x = min(needed, params.group_limit);
    uint y = x > 0u ? (needed - 1u) / x + 1u : 0u;
    groups[params.slot] = uvec4(x, y, needed > 0u ? 1u : 0u, 0u);
}
