// Reductions over a work-group whose size is a power of two. Call them in uniform control flow.
shared uint reduced[gl_WorkGroupSize.x];

#define GROUP_REDUCE(name, combine)                                                               \
    uint name(uint value) {                                                                       \
        uint lane = gl_LocalInvocationIndex;                                                      \
        barrier();                                                                                \
        reduced[lane] = value;                                                                    \
        for (uint width = gl_WorkGroupSize.x / 2u; width > 0u; width /= 2u) {                     \
            barrier();                                                                            \
            if (lane < width) {                                                                   \
                reduced[lane] = combine(reduced[lane], reduced[lane + width]);                    \
            }                                                                                     \
        }                                                                                         \
        barrier();                                                                                \
        return reduced[0];                                                                        \
    }

uint plus(uint a, uint b) { return a + b; }

GROUP_REDUCE(group_sum, plus)
GROUP_REDUCE(group_max, max)
