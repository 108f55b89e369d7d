#include "shared/kernels/methods/film_sums.h"
#include "shared/kernels/methods/passed_light.h"

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
    FilmSums sums = film_sums(f);
    for (uint j = i; j < count && keys[j] != params.none && pixel_of(keys[j]) == pixel; ++j) {
        uint slot = slots[j];
        SplatRecord s = splats[slot];
        vec3 radiance = vec3(s.r, s.g, s.b) * params.samples * passed_light(slot);
        if ((keys[j] & 1u) != 0u) {
            add_compensated(sums.caustic, sums.lost_caustic, radiance);
        } else {
            add_compensated(sums.indirect, sums.lost_indirect, radiance);
        }
    }
    film[pixel - params.first] = film_record(sums, f);
}
