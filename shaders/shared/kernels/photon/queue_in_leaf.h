// Whether a record lies in a cell: the test of a point and a half-open box of Shi 2012,
// algorithm 1.
FN bool is_in_leaf(PhotonRecord p, uint cell, BoxRecord e) {
    bool apart = photon_is_caustic(p.normal) && (p.normal & area_sample_bit) == 0u;
    bool of_kind = params.caustic == 0u || apart == (cell >= params.caustic);
    return p.normal != no_photon && of_kind && p.x >= e.low_x && p.x < e.high_x && p.y >= e.low_y &&
           p.y < e.high_y && p.z >= e.low_z && p.z < e.high_z;
}

FN BoxRecord extent_of(uint cell) {
    bool apart = params.caustic > 0u && cell >= params.caustic;
    return extents[apart ? cell - params.caustic : cell];
}
