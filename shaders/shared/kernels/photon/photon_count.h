// The word of a code that tells empty slots and caustic photons apart.
FN uint highest_word(uint i) { return codes[codes64 ? 2u * i + 1u : i]; }

FN bool is_empty(uint i) { return highest_word(i) == no_photon; }

FN bool is_caustic_or_empty(uint i) { return (highest_word(i) & photon_kind_bit) != 0u; }

// The sorted codes end with those of caustic photons, and then of empty slots. The invocation at
// the last photon of each kind knows the number of photons up to it.
FN void main() {
    uint i = THREAD_INDEX;
    uint slots = counters[counter_stored_slots];
    if (i >= slots || is_empty(i)) {
        return;
    }
    bool last = i + 1u == slots;
    if (last || is_empty(i + 1u)) {
        counters[counter_stored] = i + 1u;
    }
    if (!is_caustic_or_empty(i) && (last || is_caustic_or_empty(i + 1u))) {
        counters[counter_others] = i + 1u;
    }
}
