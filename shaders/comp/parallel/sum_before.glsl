// The sum of part_sums[0 .. part). A whole group computes it, or one lane where GROUP_SIZE is not
// defined.
#ifdef GROUP_SIZE

uint sum_before(uint part, uint lane) {
    uint value = 0u;
    for (uint i = lane; i < part; i += GROUP_SIZE) {
        value += part_sums[i];
    }
    uint total;
    group_exclusive_sum(value, total);
    return total;
}

#else

uint sum_before(uint part) {
    uint sum = 0u;
    for (uint i = 0u; i < part; ++i) {
        sum += part_sums[i];
    }
    return sum;
}

#endif
