// Between two bounces: reserves the slots that the last bounce used, and makes its survivors the
// photons of the next.
FN void main() {
    if (params.stored != 0u) {
        counters[counter_stored_slots] =
            min(counters[counter_stored_slots] + counters[counter_active], params.capacity);
    }
    counters[counter_active] = counters[counter_next_active];
}
