// Finds the first of the sorted records in each cell, and their number behind the last cell.
FN void main() {
    uint cell = THREAD_INDEX;
    if (cell > params.cells) {
        return;
    }
    uint low = 0u;
    uint high = params.count;
    while (low < high) {
        uint middle = low + (high - low) / 2u;
        if (cells[middle] < cell) {
            low = middle + 1u;
        } else {
            high = middle;
        }
    }
    starts[cell] = low;
}
