// Finds the cell of each record by a descent through the tree of cells (cell_at). Empty slots get
// the number behind all cells.
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
