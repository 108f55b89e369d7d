// Marks the entries that stay: those of blocks that are not dropped, if their cell has not been
// emptied since the block was traced, and nothing has moved on their path. One more flag, 0, ends
// them.
FN void main() {
    uint i = THREAD_INDEX;
    if (i > params.count) {
        return;
    }
    bool keep = false;
    if (i < params.count) {
        QueueBlock block = blocks[entries[i] >> queue_block_shift];
        keep = block.moment > emptied[cells[i]];
        if (keeps_paths && keep) {
            keep = block.moment > ends[block.first + (entries[i] & queue_record_mask)].crossed;
        }
    }
    flags[i] = keep ? 1u : 0u;
}
