// Finds the element of which copy j is: the last one before whose copies there are at most j.
FN void main() {
    uint j = THREAD_INDEX;
    if (j >= params.copies) {
        return;
    }
    uint first = 0u;
    uint end = params.elements;
    while (end - first > 1u) {
        uint middle = first + (end - first) / 2u;
        if (sums[middle] <= j) {
            first = middle;
        } else {
            end = middle;
        }
    }
    sources[j] = first;
}
