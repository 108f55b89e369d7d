FN bool is_in_part(uint normal) {
    bool caustic = photon_is_caustic(normal);
    return params.part == map_whole || caustic == (params.part == map_caustic);
}

// Flags the photons that may reach a query, those of the box of all queries' balls. Photons are
// params.first to params.end; flags[0] belongs to the first.
FN void main() {
    uint i = params.first + THREAD_INDEX;
    if (i >= params.end) {
        return;
    }
    PhotonRecord photon = photons[i];
    bool is_there = photon.normal != no_photon && is_in_part(photon.normal);
    vec3 extent = vec3(params.reach);
    if (of_footprints && is_there) {
        vec3 normal = unpack_photon_normal(photon.normal);
        FootprintDuals duals = unpack_duals(footprints[i]);
        // Slightly enlarged, for rounding and packing.
        extent = footprint_extent(footprint_of_duals(duals, normal, params.flatness)) * real(1.001);
        extents[i - params.first] = vec4(extent, real(0.0));
    }
    vec3 p = vec3(photon.x, photon.y, photon.z);
    flags[i - params.first] =
        is_there && reaches(p, extent, box_low(boxes[0]), box_high(boxes[0])) ? 1u : 0u;
}
