// Marks the entries that stay: those of blocks that are not dropped, if their cell has not been
// emptied since the block was traced. One more flag, 0, ends them.
FN void main() {
    uint i = THREAD_INDEX;
    if (i > params.count) {
        return;
    }
    bool keep = false;
    if (i < params.count) {
        keep = blocks[entries[i] >> queue_block_shift].moment > emptied[cells[i]];
    }
    flags[i] = keep ? 1u : 0u;
}
