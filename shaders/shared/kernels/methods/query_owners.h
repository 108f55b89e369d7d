// Replaces the entry of each query's cell in `sources` by the slot whose estimate the query takes:
// the cell's owner, or its own slot if it shares none. Only owners are chosen to be answered.
FN void main() {
    uint i = THREAD_INDEX;
    if (i >= counts[0]) {
        return;
    }
    chosen[i] = 0u;
    uint slot = active_slots[i];
    if ((query_kinds[slot] & query_kind_mask) != params.query_kind) {
        return;
    }
    uint entry = sources[slot];
    uint owner = entry == no_query ? slot : slot_of_shuffled(owners[entry]);
    sources[slot] = owner;
    chosen[i] = owner == slot ? 1u : 0u;
}
