// Length of the rays, over the distance of the centroid. Where some light comes from behind a wall
// and some from before it, the centroid may lie before it.
CONSTANT real wall_ray_length = real(1.5);

// Writes a ray from each query towards the centroid of its photons' flux, where that is one-sided.
// The ray starts a little above the query's plane and never leads below it: it passes over a
// surface that curves away, and through the air before one that curves up. Other rays have no
// length.
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
    vec3 direction = unit_and_length(offset - normal * min(dot3(offset, normal), real(0.0)), size);
    vec3 origin = vec3(q.x, q.y, q.z) + normal * (wall_ray_height * size + params.error);
    rays[slot] = RayRecord(origin.x, origin.y, origin.z,
                           size > real(0.0) ? wall_ray_length * size : -real(1.0), direction.x,
                           direction.y, direction.z, 0u);
}
