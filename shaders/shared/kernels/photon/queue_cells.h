// Finds the cell of each record by a descent through the tree of cells. Empty slots get the number
// behind all cells.
FN uint cell_at(vec3 p) {
    uint node = 0u;
    uint link = nodes[0].link;
    while ((link >> cell_axis_shift) != cell_is_leaf) {
        uint axis = link >> cell_axis_shift;
        real coordinate = axis == 0u ? p.x : axis == 1u ? p.y : p.z;
        node = coordinate < nodes[node].split ? node + 1u : link & cell_link_mask;
        link = nodes[node].link;
    }
    return link & cell_link_mask;
}

FN void main() {
    uint i = THREAD_INDEX;
    if (i >= params.count) {
        return;
    }
    PhotonRecord p = photons[params.first + i];
    uint cell = params.cells;
    if (p.normal != no_photon) {
        bool apart = photon_is_caustic(p.normal) && (p.normal & area_sample_bit) == 0u;
        cell = cell_at(vec3(p.x, p.y, p.z)) + (apart ? params.caustic : 0u);
    }
    cells[i] = cell;
    order[i] = i;
}
