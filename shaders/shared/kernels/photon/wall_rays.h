// Writes a ray from each query to the centroid of its photons' flux, where that is one-sided. The
// ray runs along the query's plane, a little above it. Other rays have no length.
FN void main() {
    uint i = THREAD_INDEX;
    if (i >= counts[params.count_index]) {
        return;
    }
    uint slot = active_slots[i];
    EstimateRecord e = estimates[slot];
    QueryRecord q = queries[slot];
    vec3 normal = unpack_unit(q.geometric_normal);
    vec3 offset = vec3(e.offset_x, e.offset_y, e.offset_z);
    real size;
    vec3 direction = unit_and_length(offset - normal * dot3(offset, normal), size);
    vec3 origin = vec3(q.x, q.y, q.z) + normal * (wall_ray_height * size + params.error);
    rays[slot] = RayRecord(origin.x, origin.y, origin.z, size > real(0.0) ? size : -real(1.0),
                           direction.x, direction.y, direction.z, 0u);
}
