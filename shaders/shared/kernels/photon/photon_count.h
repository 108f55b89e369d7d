// No photon's code has this high word.
FN bool is_empty(uint i) { return codes[codes64 ? 2u * i + 1u : i] == no_photon; }

// The sorted codes end with those of empty slots. The invocation at the first of them knows the
// number of photons.
FN void main() {
    uint i = THREAD_INDEX;
    uint slots = counters[counter_stored_slots];
    if (i >= slots || is_empty(i)) {
        return;
    }
    if (i + 1u == slots || is_empty(i + 1u)) {
        counters[counter_stored] = i + 1u;
    }
}
