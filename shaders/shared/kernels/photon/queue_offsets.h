// Copies what the queue keeps for the footprints of its records into the order of their cells.
FN void main() {
    uint i = THREAD_INDEX;
    if (i >= params.count) {
        return;
    }
    uint entry = entries[i];
    offsets[i] =
        stored_offsets[blocks[entry >> queue_block_shift].first + (entry & queue_record_mask)];
}
