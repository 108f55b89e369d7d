// Marks the area samples among the records of a map.
FN void main() {
    uint i = THREAD_INDEX;
    if (i < counters[counter_stored]) {
        marks[i] = (photons[i].normal & area_sample_bit) != 0u ? 1u : 0u;
        indices[i] = i;
    }
}
