// Sum of part_sums[0 .. part), by a whole group.
uint sum_before(uint part, uint lane) {
    uint value = 0u;
    for (uint i = lane; i < part; i += GROUP_SIZE) {
        value += part_sums[i];
    }
    uint total;
    group_exclusive_sum(value, total);
    return total;
}
