// The weight of a photon, where blocks up to the moment `end` do not count: those of the blocks
// that do sum to 1.
FN real weight_since(uint block, uint end) {
    real sum = real(0.0);
    for (uint b = 0u; b < params.blocks; ++b) {
        sum += blocks[b].moment > end ? blocks[b].weight : real(0.0);
    }
    return sum > real(0.0) ? blocks[block].weight / sum : real(0.0);
}

// The same by its light: a row of weights for each block, which sum to 1 for each light.
FN real weight_by_light(uint block, uint light, uint end) {
    real weight = weights[block * params.lights + light];
    if (end == 0u) {
        return weight;
    }
    real sum = real(0.0);
    for (uint b = 0u; b < params.blocks; ++b) {
        sum += blocks[b].moment > end ? weights[b * params.lights + light] : real(0.0);
    }
    return sum > real(0.0) ? weight / sum : real(0.0);
}

// Copies the queue's records into the order of their cells, with flux by the weights of their
// blocks. Area samples stay as they are.
FN void main() {
    uint i = THREAD_INDEX;
    if (i >= params.count) {
        return;
    }
    uint of_block = entries[i] >> queue_block_shift;
    QueueBlock block = blocks[of_block];
    uint place = block.first + (entries[i] & queue_record_mask);
    PhotonRecord p = stored[place];
    if (block.moment != queue_always) {
        real scale = block.weight * scales[cells[i]];
        uint end = emptied[cells[i]];
        if (keeps_paths && ends[place].crossed > end) {
            end = ends[place].crossed;
            scale = weight_since(of_block, end);
        }
        if (keeps_lights) {
            scale = weight_by_light(of_block, stored_lights[place], end);
        }
        p.flux_r *= scale;
        p.flux_g *= scale;
        p.flux_b *= scale;
    }
    sorted[i] = p;
}
