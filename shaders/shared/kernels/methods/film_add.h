#include "shared/kernels/interleave.h"
#include "shared/kernels/methods/film_sums.h"

// Adds the layers of a batch to the film. An invocation adds the samples of one pixel in their
// order, so that sums do not depend on scheduling.
FN void main() {
    uint i = THREAD_INDEX;
    if (i >= batch.pixels || unfinished[0] > 0u) {
        return;
    }
    uint pixel = batch.first_pixel - batch.first_film_pixel + interleave(i, batch.pixels);
    FilmRecord f = film[pixel];
    FilmSums sums = film_sums(f);
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
        add_compensated(sums.direct, sums.lost_direct, vec3(l.direct_r, l.direct_g, l.direct_b));
        add_compensated(sums.indirect, sums.lost_indirect,
                        vec3(l.indirect_r, l.indirect_g, l.indirect_b));
        add_compensated(sums.caustic, sums.lost_caustic,
                        vec3(l.caustic_r, l.caustic_g, l.caustic_b));
    }
    film[pixel] = film_record(sums, f);
}
