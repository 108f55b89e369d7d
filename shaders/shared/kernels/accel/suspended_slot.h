// Counts a ray that has used up its steps. slot: the ray's slot of so many words, or 0 if it has
// none yet. Returns its slot, or 0 if it cannot be suspended.
FN uint slot_to_suspend(uint slot, uint stride) {
    if (!resume && params.last == 0u) {
        uint mine = atomicAdd(suspended[0], 1u);
        slot = mine < params.slot_count ? suspended_head + mine * stride : 0u;
    }
    slot = params.last != 0u ? 0u : slot;
    if (slot == 0u) {
        atomicAdd(unfinished[0], 1u);
    } else {
        atomicAdd(suspended[1], 1u);
    }
    return slot;
}
