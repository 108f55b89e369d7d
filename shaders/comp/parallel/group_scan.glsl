// Exclusive sums over a work-group of GROUP_SIZE invocations, with subgroup arithmetic where SUBGROUPS is defined.
// Both variants make no assumption on how invocations map to subgroups: elements belong to invocations by
// scan_order(), which follows the order of the sums.
#define GROUP_SIZE 128u

#ifdef SUBGROUPS

shared uint subgroup_sums[GROUP_SIZE];

// Sum of `value` over the invocations before this one; `total`: over all. To be called in uniform control flow.
uint group_exclusive_sum(uint value, out uint total) {
    uint sum = subgroupAdd(value);
    barrier();
    if (subgroupElect()) {
        subgroup_sums[gl_SubgroupID] = sum;
    }
    barrier();
    uint before = 0u;
    total = 0u;
    for (uint i = 0u; i < gl_NumSubgroups; ++i) {
        before += i < gl_SubgroupID ? subgroup_sums[i] : 0u;
        total += subgroup_sums[i];
    }
    return before + subgroupExclusiveAdd(value);
}

uint scan_order() {
    uint total;
    return group_exclusive_sum(1u, total);
}

#else

shared uint group_sums[2u * GROUP_SIZE];

// Hillis and Steele's scan (1986) between two halves of `group_sums`.
uint group_exclusive_sum(uint value, out uint total) {
    uint lane = gl_LocalInvocationIndex;
    uint half_at = 0u;
    uint sum = value;
    barrier();
    group_sums[lane] = sum;
    for (uint step = 1u; step < GROUP_SIZE; step <<= 1u) {
        barrier();
        sum += lane >= step ? group_sums[half_at + lane - step] : 0u;
        half_at = GROUP_SIZE - half_at;
        group_sums[half_at + lane] = sum;
    }
    barrier();
    total = group_sums[half_at + GROUP_SIZE - 1u];
    return sum - value;
}

uint scan_order() { return gl_LocalInvocationIndex; }

#endif
