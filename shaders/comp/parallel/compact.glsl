// The interface of the kernels compact_parts_*.
#include "shared/parallel_records.h"

layout(set = 0, binding = 0) readonly buffer Flags { uvec4 flags[]; };
layout(set = 0, binding = 1) readonly buffer Values { uvec4 values[]; };
layout(set = 0, binding = 2) readonly buffer Counts { uint counts[]; };
layout(set = 0, binding = 3) readonly buffer PartSums { uint part_sums[]; };
layout(set = 0, binding = 4) writeonly buffer Out { uint kept[]; };
layout(set = 0, binding = 5) writeonly buffer Totals { uint totals[]; };
layout(push_constant) uniform Push { CompactParams params; };
#include "parallel/parts.glsl"
#include "parallel/sum_before.glsl"

// Writes the flagged ones of four values from kept[to] on. Returns the index after the last one.
uint keep_flagged(uvec4 flagged, uvec4 four, uint to) {
    for (uint k = 0u; k < 4u; ++k) {
        if (flagged[k] != 0u) {
            kept[to] = four[k];
            ++to;
        }
    }
    return to;
}
