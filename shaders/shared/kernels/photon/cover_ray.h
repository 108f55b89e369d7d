// Writes a ray of this length that starts at params.height over a place, against the normal.
FN void leave_cover_ray(uint i, vec3 place, vec3 normal, real t_max) {
    vec3 origin = place + params.height * normal;
    rays[i] = RayRecord(origin.x, origin.y, origin.z, t_max, -normal.x, -normal.y, -normal.z, 0u);
    active_slots[i] = i;
}
