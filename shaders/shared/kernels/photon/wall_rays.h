#include "shared/kernels/photon/wall.h"

// Writes a ray from each query to the centroid of its photons' flux, where that is one-sided. The
// ray runs along the query's plane, a little above it. Other rays have no length.
FN void main() {
    uint slot;
    vec3 offset;
    if (!find_centroid(slot, offset)) {
        return;
    }
    QueryRecord q = queries[slot];
    vec3 normal = unpack_unit(q.geometric_normal);
    real size;
    vec3 direction = unit_and_length(offset - normal * dot3(offset, normal), size);
    vec3 origin = vec3(q.x, q.y, q.z) + normal * (wall_ray_height * size + params.error);
    rays[slot] = RayRecord(origin.x, origin.y, origin.z, size > real(0.0) ? size : -real(1.0),
                           direction.x, direction.y, direction.z, 0u);
}
