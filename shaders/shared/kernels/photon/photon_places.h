// Flags the slots that hold a record, and lists all slots.
FN void main() {
    uint i = THREAD_INDEX;
    if (i < counters[counter_stored_slots]) {
        heads[i] = photons[i].normal == no_photon ? 0u : 1u;
        places[i] = i;
    }
}
