// Whether a segment comes into a closed box. Numbers that overflow count as inside.
FN bool is_crossed(BoxRecord box, vec3 from, vec3 to) {
    vec3 low = vec3(box.low_x, box.low_y, box.low_z);
    vec3 high = vec3(box.high_x, box.high_y, box.high_z);
    vec3 e = (high - low) * real(0.5);
    vec3 h = (to - from) * real(0.5);
    vec3 c = (from + to) * real(0.5) - (low + high) * real(0.5);
    vec3 a = abs(h);
    // Axes that may part them (Gottschalk et al. 1996): the box's, and their products with the
    // segment.
    if (abs(c.x) > e.x + a.x || abs(c.y) > e.y + a.y || abs(c.z) > e.z + a.z) {
        return false;
    }
    return !(abs(c.y * h.z - c.z * h.y) > e.y * a.z + e.z * a.y ||
             abs(c.z * h.x - c.x * h.z) > e.z * a.x + e.x * a.z ||
             abs(c.x * h.y - c.y * h.x) > e.x * a.y + e.y * a.x);
}

// Finds for records of a block, or of all blocks, the last moment at which a mesh left or entered a
// box on their path. Either they keep it, or they are only counted.
FN void main() {
    uint i = THREAD_INDEX;
    if (i >= params.count) {
        return;
    }
    counts[i] = 0u;
    uint of_block = entries[i] >> queue_block_shift;
    if (of_block == params.blocks || (params.block != every_block && of_block != params.block)) {
        return;
    }
    uint place = blocks[of_block].first + (entries[i] & queue_record_mask);
    uint first = of_block * params.vertex_room;
    PathVertex v = vertices[first + ends[place].vertex];
    uint crossed = 0u;
    while (v.previous != no_vertex) {
        PathVertex before = vertices[first + v.previous];
        for (uint b = 0u; b < params.boxes; ++b) {
            if (moments[b] > crossed &&
                is_crossed(moved[b], vec3(before.x, before.y, before.z), vec3(v.x, v.y, v.z))) {
                crossed = moments[b];
            }
        }
        v = before;
    }
    counts[i] = crossed > 0u ? 1u : 0u;
    if (crossed > 0u && marks) {
        ends[place].crossed = crossed;
    }
}
