// Computes the box around the positions of each block of area samples.
FN void main() {
    uint first = THREAD_INDEX * area_block;
    if (first >= params.samples) {
        return;
    }
    vec3 low = vec3(real(3.0e38));
    vec3 high = vec3(-real(3.0e38));
    for (uint k = first; k < min(first + area_block, params.samples); ++k) {
        PhotonRecord sampled = photons[places[k]];
        vec3 p = vec3(sampled.x, sampled.y, sampled.z);
        low = min(low, p);
        high = max(high, p);
    }
    boxes[THREAD_INDEX] =
        BoxRecord(low.x, low.y, low.z, real(0.0), high.x, high.y, high.z, real(0.0));
}
