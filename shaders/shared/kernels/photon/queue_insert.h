// Adds the entries of a new block, in the order of their cells, behind the old ones of their cells.
FN void main() {
    uint i = THREAD_INDEX;
    if (i >= params.count || cells[i] >= params.cells) {
        return;
    }
    uint place = i + ranks[starts[cells[i] + 1u]];
    next_entries[place] = (params.block << queue_block_shift) | i;
    next_cells[place] = cells[i];
}
