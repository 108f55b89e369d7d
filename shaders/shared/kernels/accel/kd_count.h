FN void add_counts(uint node, uvec3 lefts, uvec3 rights) {
    atomicAdd(counts[6u * node], lefts.x);
    atomicAdd(counts[6u * node + 1u], lefts.y);
    atomicAdd(counts[6u * node + 2u], lefts.z);
    atomicAdd(counts[6u * node + 3u], rights.x);
    atomicAdd(counts[6u * node + 4u], rights.y);
    atomicAdd(counts[6u * node + 5u], rights.z);
}

// Counts the elements on either side of the planes of a level's nodes, of a run of references.
FN void main() {
    uint i = THREAD_INDEX * segment_run;
    uint end = min(i + segment_run, params.end);
    uint node = no_segment;
    uvec3 lefts = uvec3(0u);
    uvec3 rights = uvec3(0u);
    vec3 split = vec3(real(0.0));
    for (; i < end; ++i) {
        if (segments[i] != node) {
            if (node != no_segment) {
                add_counts(node, lefts, rights);
            }
            node = segments[i];
            lefts = uvec3(0u);
            rights = uvec3(0u);
            split = vec3(plans[node].split_x, plans[node].split_y, plans[node].split_z);
        }
        vec3 low = bits_float(uvec3(references[lanes * i]));
        vec3 high = bits_float(uvec3(references[lanes * i + lanes - 1u]));
        lefts += uvec3(lessThan(low, split));
        rights += uvec3(1u) - uvec3(lessThan(high, split));
    }
    if (node != no_segment) {
        add_counts(node, lefts, rights);
    }
}
