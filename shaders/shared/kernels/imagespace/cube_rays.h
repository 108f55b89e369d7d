// Writes a ray from a map's center through the middle of each texel.
FN void main() {
    uint i = THREAD_INDEX;
    if (i >= batch.count) {
        return;
    }
    uint texel = batch.first + i;
    uint in_map = cube_texels(batch.size);
    vec3 center = vec3(centers[texel / in_map]);
    real extent;
    vec3 direction = unit_and_length(cube_direction(texel % in_map, batch.size), extent);
    rays[i] = RayRecord(center.x, center.y, center.z, far_away, direction.x, direction.y,
                        direction.z, 0u);
    active_rays[i] = i;
}
