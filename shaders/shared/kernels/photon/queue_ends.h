// Finds the first entry of each cell after entries were dropped and added, and their number.
FN void main() {
    uint cell = THREAD_INDEX;
    if (cell <= params.cells) {
        next_starts[cell] = ranks[starts[cell]] + fresh_starts[cell];
    }
}
