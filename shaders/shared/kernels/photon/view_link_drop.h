// What happens to places that are not linked (LinkedPlace).

FN void mark_unlinked(uint bit) {
    uint mark = 1u << (bit & 31u);
    uint word = 0u;
    for (;;) {
        uint other = atomicCompSwap(unlinked_cells[bit >> 5u], word, word | mark);
        if (other == word || (other & mark) != 0u) {
            return;
        }
        word = other;
    }
}

// Drops a photon, or takes the area of a side and marks its cell: only there do photons need rays.
FN void drop_unlinked(IN(LinkedPlace) place) {
    if (params.sides == 1u) {
        photons[place.slot].normal = no_photon;
        return;
    }
    if (place.side == 0u) {
        photons[place.slot].flux_r = real(0.0);
    } else {
        photons[place.slot].flux_g = real(0.0);
    }
    mark_unlinked(view_filter_bit(view_cell(place.p, place.normal, params.cells), params.mask));
}
