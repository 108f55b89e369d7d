// Lists the flagged photons as the references of the root.
FN void main() {
    uint i = params.first + THREAD_INDEX;
    if (i >= params.end || flags[i - params.first] == 0u) {
        return;
    }
    uint to = sums[i - params.first];
    PhotonRecord p = photons[i];
    references[to] = uvec4(float_bits(vec3(p.x, p.y, p.z)), i);
}
