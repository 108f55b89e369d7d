// The place of each record, as a box, for the build of a kd-tree.
FN void main() {
    uint i = THREAD_INDEX;
    if (i >= params.count) {
        return;
    }
    PhotonRecord p = photons[i];
    boxes[i] = BoxRecord(p.x, p.y, p.z, real(0.0), p.x, p.y, p.z, real(0.0));
}
