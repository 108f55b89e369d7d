// Exclusive sums over a work-group of GROUP_SIZE invocations, with subgroup arithmetic where
// SUBGROUPS is defined. How invocations map to subgroups does not matter: invocations take elements
// by scan_order(), which is the order of the sums.
#define GROUP_SIZE 128u

#ifdef SUBGROUPS

shared uint subgroup_sums[GROUP_SIZE];

// Returns the sum of `value` over the invocations before this one; total: the sum over all. Call it
// in uniform control flow.
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

// The scan of Hillis and Steele (1986), which alternates between two halves of `group_sums`.
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
