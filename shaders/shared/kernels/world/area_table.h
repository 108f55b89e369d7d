// Writes the table of areas.
FN void main() {
    uint k = THREAD_INDEX;
    if (k >= params.count) {
        return;
    }
    uvec2 piece = pieces[order[k]];
    area_sums[k].before = fixed_ratio(uvec2(low_sums[k], high_sums[k]),
                                      uvec2(low_sums[params.count], high_sums[params.count]));
    area_sums[k].triangle = piece.x;
    area_sums[k].piece = piece.y;
}
