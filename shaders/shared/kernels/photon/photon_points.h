// Writes the box of each photon, which is a point, so that the boxes can be reduced to their union.
// The boxes of empty slots and of area samples are empty.
FN void main() {
    uint i = THREAD_INDEX;
    if (i >= counters[counter_stored_slots]) {
        return;
    }
    PhotonRecord p = photons[i];
    bool empty = (p.normal & area_sample_bit) != 0u; // as are all bits of no_photon
    vec3 position = vec3(p.x, p.y, p.z);
    vec3 beyond = vec3(far_away);
    boxes[2u * i] = vec4(empty ? beyond : position, real(0.0));
    boxes[2u * i + 1u] = vec4(empty ? -beyond : position, real(0.0));
}
