// No photon's high word is so large.
FN bool is_empty(uint i) { return codes[wide ? 2u * i + 1u : i] == no_photon; }

// The sorted codes end in those of empty slots; whoever stands at the border knows the number of
// photons.
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
