// Copies the queue's records into the order of their cells, with flux by the weights of their
// blocks. Area samples stay as they are.
FN void main() {
    uint i = THREAD_INDEX;
    if (i >= params.count) {
        return;
    }
    QueueBlock block = blocks[entries[i] >> queue_block_shift];
    PhotonRecord p = stored[block.first + (entries[i] & queue_record_mask)];
    if (block.moment != queue_always) {
        real scale = block.weight * scales[cells[i]];
        p.flux_r *= scale;
        p.flux_g *= scale;
        p.flux_b *= scale;
    }
    sorted[i] = p;
}
