// Codes order records along a space-filling curve through the cube around all photons, with caustic
// photons behind all others. Empty slots get the largest code and go to the end.
FN void main() {
    uint i = THREAD_INDEX;
    if (i >= counters[counter_stored_slots]) {
        return;
    }
    PhotonRecord p = photons[i];
    vec3 low = vec3(bounds[0]);
    vec3 high = low + vec3(max_component(vec3(bounds[1]) - low));
    vec3 position = vec3(p.x, p.y, p.z);
    bool empty = p.normal == no_photon;
    uint kind = photon_is_caustic(p.normal) ? photon_kind_bit : 0u;
    if (codes64) {
        uvec2 code = morton63(position, low, high);
        codes[2u * i] = empty ? no_photon : code.x;
        codes[2u * i + 1u] = empty ? no_photon : code.y | kind;
    } else {
        codes[i] = empty ? no_photon : (morton30(position, low, high) << 1u) | kind;
    }
    order[i] = i;
}
