#include "shared/kernels/interleave.h"

// Adds the layers of a batch to the film. An invocation adds the samples of one pixel in their
// order, so that sums do not depend on scheduling.
FN void main() {
    uint i = THREAD_INDEX;
    if (i >= batch.pixels || unfinished[0] > 0u) {
        return;
    }
    uint pixel = batch.first_pixel - batch.first_film_pixel + interleave(i, batch.pixels);
    FilmRecord f = film[pixel];
    vec3 direct = vec3(f.direct_r, f.direct_g, f.direct_b);
    vec3 indirect = vec3(f.indirect_r, f.indirect_g, f.indirect_b);
    vec3 caustic = vec3(f.caustic_r, f.caustic_g, f.caustic_b);
    vec3 lost_direct = vec3(f.lost_direct_r, f.lost_direct_g, f.lost_direct_b);
    vec3 lost_indirect = vec3(f.lost_indirect_r, f.lost_indirect_g, f.lost_indirect_b);
    vec3 lost_caustic = vec3(f.lost_caustic_r, f.lost_caustic_g, f.lost_caustic_b);
    for (uint s = 0u; s < batch.samples; ++s) {
        LayersRecord l = layers[i * batch.samples + s];
        bool finite = is_finite(l.direct_r + l.direct_g + l.direct_b) &&
                      is_finite(l.indirect_r + l.indirect_g + l.indirect_b) &&
                      is_finite(l.caustic_r + l.caustic_g + l.caustic_b);
        f.samples += 1u;
        f.samples_high += f.samples == 0u ? 1u : 0u;
        if (!finite) {
            f.non_finite += 1u;
            f.non_finite_high += f.non_finite == 0u ? 1u : 0u;
            continue;
        }
        add_compensated(direct, lost_direct, vec3(l.direct_r, l.direct_g, l.direct_b));
        add_compensated(indirect, lost_indirect, vec3(l.indirect_r, l.indirect_g, l.indirect_b));
        add_compensated(caustic, lost_caustic, vec3(l.caustic_r, l.caustic_g, l.caustic_b));
    }
    film[pixel] = FilmRecord(direct.x, direct.y, direct.z, f.samples, indirect.x, indirect.y,
                             indirect.z, f.samples_high, caustic.x, caustic.y, caustic.z,
                             f.non_finite, lost_direct.x, lost_direct.y, lost_direct.z,
                             f.non_finite_high, lost_indirect.x, lost_indirect.y, lost_indirect.z,
                             real(0.0), lost_caustic.x, lost_caustic.y, lost_caustic.z, real(0.0));
}
