#include "shared/kernels/imagespace/cube_sees.h"

// Counts the points that each candidate sees and no other chosen map does. Before any is chosen, it
// finds those that some candidate sees.
FN void main() {
    uint i = THREAD_INDEX;
    if (i >= params.maps * params.points) {
        return;
    }
    uint map = i / params.points;
    uint point = i % params.points;
    uint place = params.maps * cube_texels(params.size) + point;
    uint mask = masks[place] & ~unseen_by_any;
    if ((mask & ~candidates[map].ignored) == 0u &&
        map_sees(map, vec3(points[point]), no_triangle)) {
        atomicAdd(candidates[map].points, 1u);
        atomicMin(masks[place], mask);
    }
}
