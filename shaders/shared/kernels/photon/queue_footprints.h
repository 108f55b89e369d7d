#include "shared/kernels/photon/queue_box.h"

// Packs the footprints of the queue's records as dual axes, in the order of their cells, sums their
// areas relative to the scene's, and lets the boxes of the cells grow around them, so that a walk
// goes as far as the largest footprint of a cell reaches. Those of area samples were made before
// (queue_area_footprints); they only get as much wider as those of photons.
FN void main() {
    uint i = THREAD_INDEX;
    if (i >= params.count) {
        return;
    }
    uint entry = entries[i];
    uint place = blocks[entry >> queue_block_shift].first + (entry & queue_record_mask);
    PhotonRecord p = stored[place];
    vec3 normal = unpack_photon_normal(p.normal);
    FootprintDuals duals = unpack_duals(stored_offsets[place]);
    shares[i] = 0u;
    if ((p.normal & area_sample_bit) != 0u) {
        duals.a = duals.a / params.area_widening;
        duals.b = duals.b / params.area_widening;
    } else {
        PhotonDifferential d = no_differential();
        d.dp_du = duals.a; // the words hold the differentials
        d.dp_dv = duals.b;
        Footprint f = make_footprint(d, normal, photon_is_caustic(p.normal), params.scale);
        real share = footprint_area(f) * params.inverse_surface_area * real(area_shares);
        shares[i] = uint(min(share, real(area_shares)) + real(0.5));
        duals = footprint_duals(f, normal);
    }
    uvec4 packed = uvec4(pack_dual(duals.a), pack_dual(duals.b));
    footprints[i] = packed;
    Footprint stored_one = footprint_of_duals(unpack_duals(packed), normal, params.scale.flatness);
    // Enlarged as in photon_boxes.h.
    vec3 half_size = footprint_extent(stored_one) * real(1.001);
    vec3 center = vec3(p.x, p.y, p.z);
    grow(cells[i], center - half_size, center + half_size);
}
