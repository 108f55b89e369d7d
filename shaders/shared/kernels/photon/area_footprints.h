// Mean radius of the photons nearby. Where photons spread as far as their neighbours do, part of
// them falls off the surface's edge; area samples with the same radius miss the same share.
FN real radius_nearby(uint i) {
    uint first = i - min(i, area_neighbours);
    uint last = min(i + area_neighbours, counters[counter_stored] - 1u);
    real sum = real(0.0);
    real count = real(0.0);
    for (uint j = first; j <= last; ++j) {
        if ((photons[j].normal & (area_sample_bit | photon_caustic_bit)) == 0u) {
            FootprintDuals duals = unpack_duals(footprints[j]);
            sum += mean_radius(duals);
            count += real(1.0);
        }
    }
    // Without photons nearby, no photon is missing.
    return count > real(0.0) ? sum / count : params.scale.radius_max;
}

// Computes the footprints of area samples, in the order of the map.
FN void main() {
    uint k = THREAD_INDEX;
    if (k >= counters[counter_area_places]) {
        return;
    }
    uint i = area_places[k];
    vec3 normal = unpack_photon_normal(photons[i].normal);
    Frame frame = make_frame(normal);
    real radius = max(radius_nearby(i), params.least_area_radius);
    FootprintDuals duals =
        footprint_duals(Footprint(frame.x * radius, frame.y * radius, normal * radius), normal);
    footprints[i] = uvec4(pack_dual(duals.a), pack_dual(duals.b));
}
