// Takes the coverage from estimates whose photons' flux has its centroid behind something, so that
// estimate_add does not take them, and the eye path goes on. Glass and veils hide as walls do.
FN void main() {
    uint i = THREAD_INDEX;
    if (i >= counts[params.count_index]) {
        return;
    }
    uint slot = active_slots[i];
    EstimateRecord e = estimates[slot];
    bool one_sided = e.offset_x != real(0.0) || e.offset_y != real(0.0) || e.offset_z != real(0.0);
    if (one_sided && occluded[slot] != 0u) {
        estimates[slot].coverage = real(0.0);
    }
}
