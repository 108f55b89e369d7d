// Keeps the footprints of area samples, which lie in another order of the queue's entries.
FN void main() {
    uint i = THREAD_INDEX;
    if (i >= params.count) {
        return;
    }
    uint entry = entries[order[i]];
    if ((entry >> queue_block_shift) == params.blocks) {
        stored_offsets[blocks[params.blocks].first + (entry & queue_record_mask)] = footprints[i];
    }
}
