// Turns the sums of queries into their answers.
#include "shared/kernels/photon/uneven.h"

#include "shared/kernels/photon/answer.h"

FN void main() {
    uint i = THREAD_INDEX;
    if (i >= params.end) {
        return;
    }
    uint slot = active_slots[i];
    GatherRecord g = gathers[slot];
    vec3 p = vec3(queries[slot].x, queries[slot].y, queries[slot].z);
    real coverage = known_coverage(p, g.coverage);
    real scale = answer_scale(coverage);
    real caustic_scale = params.caustic_correction != 0u ? scale : real(1.0);
    vec3 indirect = vec3(g.indirect_r, g.indirect_g, g.indirect_b);
    store_estimate(slot, scale * indirect,
                   caustic_scale * vec3(g.caustic_r, g.caustic_g, g.caustic_b), coverage,
                   known_unevenness(p, moments_of(g), indirect, g.coverage));
}
