// Writes the parts into which a piece is divided, or the piece itself if it is not.
FN void main() {
    uint i = THREAD_INDEX;
    if (i >= params.count) {
        return;
    }
    uvec2 piece = params.of_triangles != 0u ? uvec2(i, whole_triangle) : pieces[i];
    uint first = places[i];
    uint parts = places[i + 1u] - first;
    for (uint k = 0u; k < parts; ++k) {
        divided[first + k] = parts == 1u ? piece : uvec2(piece.x, 4u * piece.y + k);
    }
}
