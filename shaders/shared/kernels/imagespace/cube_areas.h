#include "shared/kernels/imagespace/cube_place.h"
#include "shared/kernels/imagespace/cube_sees.h"

// Adds up the areas that each candidate shows and no chosen map sees: A(v|C) of Yao et al. 2010,
// equation 1. Sums in fixed point do not depend on their order.
FN void main() {
    uint in_map = cube_texels(params.size);
    uint first = THREAD_INDEX * texels_per_area;
    if (first >= params.maps * in_map) {
        return;
    }
    uint map = first / in_map;
    uvec2 area = uvec2(0u);
    uint back = 0u;
    uint seen = 0u;
    for (uint texel = first; texel < first + texels_per_area; ++texel) {
        CubePlace place = place_of(texel);
        if (place.triangle == no_triangle) {
            continue;
        }
        real cosine = -dot3(triangle_plane(place.triangle).normal, place.direction);
        seen += 1u;
        back += cosine < real(0.0) ? 1u : 0u;
        if (abs(cosine) >= least_cosine && (masks[texel] & ~candidates[map].ignored) == 0u) {
            real depth = place.distance * place.forward;
            real shown = real(4.0) * depth * depth * place.forward /
                         (real(params.size * params.size) * abs(cosine));
            area = fixed_add(area, fixed_from_float(shown * params.inverse_unit, 0));
        }
    }
    uint before = atomicAdd(candidates[map].area_low, area.x);
    atomicAdd(candidates[map].area_high, fixed_add(uvec2(before, 0u), area).y);
    atomicAdd(candidates[map].back, back);
    atomicAdd(candidates[map].seen, seen);
}
