// Writes a short ray to each photon, against its surface's normal, which ends before the surface
// and finds what covers it. Caustic photons keep their sharp light wherever they lie.
FN void main() {
    uint i = THREAD_INDEX;
    if (i >= params.count) {
        return;
    }
    PhotonRecord p = photons[params.first + i];
    vec3 place = vec3(p.x, p.y, p.z);
    vec3 center = vec3(params.corrected_x, params.corrected_y, params.corrected_z);
    vec3 d = place - center;
    bool tested = p.normal != no_photon && !photon_is_caustic(p.normal) &&
                  dot3(d, d) <= params.corrected_distance * params.corrected_distance;
    vec3 normal = unpack_photon_normal(p.normal);
    vec3 origin = place + params.height * normal;
    real t_max = tested ? params.height - params.error : -real(1.0);
    rays[i] = RayRecord(origin.x, origin.y, origin.z, t_max, -normal.x, -normal.y, -normal.z, 0u);
    active_slots[i] = i;
}
