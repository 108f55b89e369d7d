// Packs footprints as dual axes, in the order of the map, and sums their areas relative to the
// scene's. Area samples, whose footprints come from their neighbours, are listed for
// area_footprints: few among many, they would stall all lanes. So are caustic photons whose
// footprints hold area samples, for caustic_cover.
FN void main() {
    uint i = THREAD_INDEX;
    if (i >= counters[counter_stored]) {
        return;
    }
    uint slot = order[i];
    uint packed = photons[slot].normal;
    if ((packed & area_sample_bit) != 0u) {
        area_places[atomicAdd(counters[counter_area_places], 1u)] = i;
        shares[i] = 0u;
        return;
    }
    PhotonDifferential d = no_differential();
    d.dp_du = unpack_dual(offsets[slot].x, offsets[slot].y);
    d.dp_dv = unpack_dual(offsets[slot].z, offsets[slot].w);
    vec3 normal = unpack_photon_normal(packed);
    bool caustic = photon_is_caustic(packed);
    Footprint f = make_footprint(d, normal, caustic, params.scale);
    real area = footprint_area(f);
    if (caustic && params.samples_per_area * area > least_cover_samples) {
        wide_caustics[atomicAdd(counters[counter_wide_caustics], 1u)] = i;
    }
    real share = area * params.inverse_surface_area * real(area_shares);
    FootprintDuals duals = footprint_duals(f, normal);
    footprints[i] = uvec4(pack_dual(duals.a), pack_dual(duals.b));
    shares[i] = uint(min(share, real(area_shares)) + real(0.5));
}
