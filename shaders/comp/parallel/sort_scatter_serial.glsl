// Body of sort_keys_serial, sort_pairs_serial (VALUES) and sort_pairs64_serial (VALUES and KEYS64).
layout(local_size_x = 8) in;
#include "shared/parallel_records.h"

layout(set = 0, binding = 0) readonly buffer Keys { uvec4 keys[]; };
layout(set = 0, binding = 1) readonly buffer Counts { uint counts[]; };
layout(set = 0, binding = 2) readonly buffer Offsets { uint offsets[]; };
#ifdef KEYS64
#define Key uvec2
#else
#define Key uint
#endif
layout(set = 0, binding = 3) writeonly buffer SortedKeys { Key sorted_keys[]; };
#ifdef VALUES
layout(set = 0, binding = 4) readonly buffer Values { uvec4 values[]; };
layout(set = 0, binding = 5) writeonly buffer SortedValues { uint sorted_values[]; };
#endif
layout(push_constant) uniform Push { SortParams params; };
#include "parallel/parts.glsl"

uint next[sort_digits];     // destination of the part's next element with each digit

void place(Key key, uint value) {
#ifdef KEYS64
    uint word = params.word == 0u ? key.x : key.y;
#else
    uint word = key;
#endif
    uint digit = (word >> params.shift) & params.digit_mask;
    uint to = next[digit];
    next[digit] = to + 1u;
    sorted_keys[to] = key;
#ifdef VALUES
    sorted_values[to] = value;
#endif
}

Key key_at(uvec4 a, uvec4 b, uint k) {
#ifdef KEYS64
    return k == 0u ? a.xy : k == 1u ? a.zw : k == 2u ? b.xy : b.zw;
#else
    return a[k];
#endif
}

// One part per lane.
void main() {
    uint part = THREAD_INDEX;
    if (part >= params.parts.parts) {
        return;
    }
    uvec2 range = part_range(part, element_count());
    for (uint digit = 0u; digit < sort_digits; ++digit) {
        next[digit] = offsets[digit * params.parts.parts + part];
    }
    for (uint i = range.x; i < range.y; i += 4u) {
        // Buffers are padded to 16 bytes, so that the last four can be read.
#ifdef KEYS64
        uvec4 a = keys[i / 2u];
        uvec4 b = i + 2u < range.y ? keys[i / 2u + 1u] : uvec4(0u);
#else
        uvec4 a = keys[i / 4u];
        uvec4 b = uvec4(0u);
#endif
#ifdef VALUES
        uvec4 four = values[i / 4u];
#else
        uvec4 four = uvec4(0u);
#endif
        place(key_at(a, b, 0u), four.x);
        if (i + 4u <= range.y) {
            place(key_at(a, b, 1u), four.y);
            place(key_at(a, b, 2u), four.z);
            place(key_at(a, b, 3u), four.w);
        } else {
            for (uint k = 1u; k < range.y - i; ++k) {
                place(key_at(a, b, k), four[k]);
            }
        }
    }
}
