FN uint pixel_of(uint key) { return key / 2u; }

// Adds sorted splats to the film. The invocation of the first splat of a pixel adds all of them in
// their order, so that sums do not depend on scheduling.
FN void main() {
    uint i = THREAD_INDEX;
    uint count = counters[counter_active];
    if (i >= count || keys[i] == params.none) {
        return;
    }
    uint pixel = pixel_of(keys[i]);
    if ((i > 0u && pixel_of(keys[i - 1u]) == pixel) || pixel < params.first ||
        pixel - params.first >= params.pixels) {
        return;
    }
    FilmRecord f = film[pixel - params.first];
    vec3 indirect = vec3(f.indirect_r, f.indirect_g, f.indirect_b);
    vec3 caustic = vec3(f.caustic_r, f.caustic_g, f.caustic_b);
    vec3 lost_indirect = vec3(f.lost_indirect_r, f.lost_indirect_g, f.lost_indirect_b);
    vec3 lost_caustic = vec3(f.lost_caustic_r, f.lost_caustic_g, f.lost_caustic_b);
    for (uint j = i; j < count && keys[j] != params.none && pixel_of(keys[j]) == pixel; ++j) {
        uint slot = slots[j];
        SplatRecord s = splats[slot];
        vec3 radiance = vec3(s.r, s.g, s.b) * params.samples;
        if (has_alpha) {
            radiance *= transmittance(occluded[slot]);
        }
        if ((keys[j] & 1u) != 0u) {
            add_compensated(caustic, lost_caustic, radiance);
        } else {
            add_compensated(indirect, lost_indirect, radiance);
        }
    }
    f.indirect_r = indirect.x;
    f.indirect_g = indirect.y;
    f.indirect_b = indirect.z;
    f.lost_indirect_r = lost_indirect.x;
    f.lost_indirect_g = lost_indirect.y;
    f.lost_indirect_b = lost_indirect.z;
    f.caustic_r = caustic.x;
    f.caustic_g = caustic.y;
    f.caustic_b = caustic.z;
    f.lost_caustic_r = lost_caustic.x;
    f.lost_caustic_g = lost_caustic.y;
    f.lost_caustic_b = lost_caustic.z;
    film[pixel - params.first] = f;
}
