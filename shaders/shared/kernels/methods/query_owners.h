// Of the entry of its cell (none: it has one of its own), makes the slot whose answer each query
// takes; only that one is chosen to ask.
FN void main() {
    uint i = THREAD_INDEX;
    if (i >= counts[0]) {
        return;
    }
    chosen[i] = 0u;
    if (asks[i] != params.asks) {
        return;
    }
    uint slot = active_slots[i];
    uint entry = sources[slot];
    uint owner = entry == no_query ? slot : slot_of_shuffled(owners[entry]);
    sources[slot] = owner;
    chosen[i] = owner == slot ? 1u : 0u;
}
