// Half extents of a photon's ellipsoid, computed from the packed record that gathering reads.
FN vec3 extent(uint i) {
    vec3 normal = unpack_photon_normal(photons[i].normal);
    return footprint_extent(
        footprint_of_duals(unpack_duals(footprints[i]), normal, params.flatness));
}

// Computes the box of each leaf, and its distance from the next leaf.
FN void main() {
    uint leaf = THREAD_INDEX;
    if (leaf >= counters[counter_leaves]) {
        return;
    }
    uint first = leaves[leaf] & leaf_first_mask;
    uint last = first + (leaves[leaf] >> leaf_first_bits);
    vec3 low = vec3(real(3.0e38));
    vec3 high = vec3(-real(3.0e38));
    for (uint i = first; i <= last; ++i) {
        vec3 p = vec3(photons[i].x, photons[i].y, photons[i].z);
        // Slightly enlarged, for rounding and packing.
        vec3 half_size = around_footprints ? extent(i) * real(1.001) : vec3(real(0.0));
        low = min(low, p - half_size);
        high = max(high, p + half_size);
    }
    boxes[leaf] = BoxRecord(low.x, low.y, low.z, real(0.0), high.x, high.y, high.z, real(0.0));
    leaf_distances[leaf] = distances[last];
}
