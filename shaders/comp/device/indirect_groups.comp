#version 460
layout(local_size_x = 1) in;
#include "kernel.glsl"
#include "shared/device_records.h"

layout(set = 0, binding = 0) readonly buffer Counts { uint counts[]; };
layout(set = 0, binding = 1) writeonly buffer Groups { uvec4 groups[]; };
layout(push_constant) uniform Push { IndirectGroupsParams params; };

// Writes the number of groups that a count of invocations takes. As in VulkanDevice::dispatch, a
// number beyond the limit of one dimension spills into the next.
void main() {
    uint count = counts[params.count_index];
    uint needed = count / params.group_size + (count % params.group_size > 0u ? 1u : 0u);
    uvec3 size = uvec3(0u);
    if (needed > 0u) {
        size.x = min(needed, params.group_limit);
        uint rows = (needed - 1u) / size.x + 1u;
        size.y = min(rows, params.group_limit);
        size.z = (rows - 1u) / size.y + 1u;
    }
    groups[params.slot] = uvec4(size, 0u);
}
