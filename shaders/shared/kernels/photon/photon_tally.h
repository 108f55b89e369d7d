// Counts the slots that hold a photon.
FN void main() {
    uint first = THREAD_INDEX * slots_per_tally;
    uint end = min(first + slots_per_tally, counters[counter_stored_slots]);
    uint count = 0u;
    for (uint i = first; i < end; ++i) {
        count += photons[i].normal == no_photon ? 0u : 1u;
    }
    if (count > 0u) {
        atomicAdd(counters[counter_photons], count);
    }
}
