// Adds the carries of the sums of low words to the high words.
FN void main() {
    uint k = THREAD_INDEX;
    if (k < params.count && low_sums[k + 1u] < low_sums[k]) {
        highs[k] += 1u;
    }
}
