// Finds the slot of an invocation's query, and the offset to the centroid of its photons' flux,
// which is 0 unless that is one-sided. Returns false if there is no query.
FN bool find_centroid(OUT(uint) slot, OUT(vec3) offset) {
    uint i = THREAD_INDEX;
    slot = 0u;
    offset = vec3(real(0.0));
    if (i >= counts[params.count_index]) {
        return false;
    }
    slot = active_slots[i];
    EstimateRecord e = estimates[slot];
    offset = vec3(e.offset_x, e.offset_y, e.offset_z);
    return true;
}
