#include "shared/kernels/imagespace/cube_place.h"
#include "shared/kernels/imagespace/cube_sees.h"

// Sets the chosen map's bit of the places and points that it sees, and clears it elsewhere; of no
// map, clears it everywhere.
FN void main() {
    uint i = THREAD_INDEX;
    uint places = params.maps * cube_texels(params.size);
    if (i >= places + params.points) {
        return;
    }
    bool sees = false;
    if (params.map < params.maps) {
        if (i < places) {
            CubePlace place = place_of(i);
            sees = place.triangle != no_triangle &&
                   map_sees(params.map, place.position, place.triangle);
        } else {
            sees = map_sees(params.map, vec3(points[i - places]), no_triangle);
        }
    }
    masks[i] = (masks[i] & ~params.bit) | (sees ? params.bit : 0u);
}
