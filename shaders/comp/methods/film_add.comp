#version 460
layout(local_size_x = 64) in;
#include "kernel.glsl"
#include "interleave.glsl"
#include "shared/maths.h"
#include "shared/path_records.h"

layout(set = 0, binding = 0) readonly buffer Layers { LayersRecord layers[]; };
layout(set = 0, binding = 1) readonly buffer Unfinished { uint unfinished[]; };
layout(set = 0, binding = 2) buffer Film { FilmRecord film[]; };
layout(push_constant) uniform Push { EyeBatch batch; };

// One pixel an invocation, its samples in their order: the sum does not depend on scheduling.
void main() {
    uint i = THREAD_INDEX;
    if (i >= batch.pixels || unfinished[0] > 0u) {
        return;
    }
    uint pixel = batch.first_pixel + interleave(i, batch.pixels);
    FilmRecord sum = film[pixel];
    for (uint s = 0u; s < batch.samples; ++s) {
        LayersRecord l = layers[i * batch.samples + s];
        bool finite = is_finite(l.direct_r + l.direct_g + l.direct_b) &&
                      is_finite(l.indirect_r + l.indirect_g + l.indirect_b) &&
                      is_finite(l.caustic_r + l.caustic_g + l.caustic_b);
        sum.samples += 1u;
        if (!finite) {
            sum.non_finite += 1u;
            continue;
        }
        sum.direct_r += l.direct_r;
        sum.direct_g += l.direct_g;
        sum.direct_b += l.direct_b;
        sum.indirect_r += l.indirect_r;
        sum.indirect_g += l.indirect_g;
        sum.indirect_b += l.indirect_b;
        sum.caustic_r += l.caustic_r;
        sum.caustic_g += l.caustic_g;
        sum.caustic_b += l.caustic_b;
    }
    film[pixel] = sum;
}
