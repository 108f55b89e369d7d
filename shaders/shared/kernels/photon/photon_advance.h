// Between two bounces: the slots that the last one used are taken, and its survivors are the next
// one's photons.
FN void main() {
    if (params.stored != 0u) {
        counters[counter_stored_slots] =
            min(counters[counter_stored_slots] + counters[counter_active], params.capacity);
    }
    counters[counter_active] = counters[counter_next_active];
}
