// Moves an entry that stays to its place: behind those that stay before it, and behind the new
// entries of the cells before its own. So old entries of a cell lie before its new ones.
FN void main() {
    uint i = THREAD_INDEX;
    if (i >= params.count || ranks[i] == ranks[i + 1u]) {
        return;
    }
    uint place = ranks[i] + fresh_starts[cells[i]];
    next_entries[place] = entries[i];
    next_cells[place] = cells[i];
}
