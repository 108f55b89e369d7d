// Makes one segment of all queries. Clears their sums if params.first is 0.
FN void main() {
    uint i = THREAD_INDEX;
    if (i >= params.end) {
        return;
    }
    uint slot = active_slots[i];
    QueryRecord q = queries[slot];
    vec3 p = vec3(q.x, q.y, q.z);
    // A box around a query that is nowhere would not end.
    places[i] = uvec4(float_bits(is_finite3(p) ? p : vec3(real(0.0))), slot);
    segments[i] = 0u;
    if (params.first == 0u) {
        real zero = real(0.0);
        gathers[slot] =
            GatherRecord(zero, zero, zero, 0u, zero, zero, zero, zero, zero, zero, zero, zero, zero,
                         zero, zero, zero, zero, zero, zero, zero, zero, zero, zero);
    }
}
