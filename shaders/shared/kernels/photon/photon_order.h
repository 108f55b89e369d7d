// Copies photons into the order of their codes.
FN void main() {
    uint i = THREAD_INDEX;
    if (i < counters[counter_stored]) {
        sorted[i] = photons[order[i]];
    }
}
