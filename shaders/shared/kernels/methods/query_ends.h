// Ends the waiting of eye paths whose queries are answered: marks those that go on.
FN void main() {
    uint i = THREAD_INDEX;
    if (i >= counts[0]) {
        return;
    }
    uint slot = active_slots[i];
    alive[i] = query_kinds[slot] & query_then_continues;
    query_kinds[slot] = 0u;
}
