#ifndef ARGAND_SHARED_FOOTPRINT_RECORDS_H
#define ARGAND_SHARED_FOOTPRINT_RECORDS_H

#include "shared/prelude.h"

ARGAND_SHARED_BEGIN

// How differentials become footprints; the same for all photons of a pass (make_footprint_scale).
struct FootprintScale {
    float32 spacing; // the spacing Δ; differentials are divided by it before they are compressed
    float32 diffuse; // semi-axis [length] = diffuse · (|dp| / spacing)^(1/4)
    float32 caustic; // semi-axis = caustic · |dp|
    float32 radius_min, radius_max;   // [length], of each semi-axis
    float32 caustic_min, caustic_max; // the same for caustic photons
    float32 flatness; // half-axis along the normal over the geometric mean of the other two
    // 1: the principal axes of the ellipse are compressed; 0: the differentials themselves.
    uint principal_axes;
    uint splats; // 1: differentials are not compressed (splat_scale)
    uint pad0, pad1;
};

struct FootprintParams {
    FootprintScale scale;
    float32 inverse_surface_area; // of the scene
    // least radius of area samples' footprints, so that some overlap everywhere
    float32 least_area_radius;
    float32 samples_per_area; // area samples; 0: caustic photons keep their flux
    uint pad0;
};

// Which footprints footprint_distances looks at.
struct FootprintDistanceParams {
    uint points;
    uint rank;       // of the distance to find among the footprints looked at, from 1
    uint stride;     // between footprints looked at
    uint footprints; // looked at
};

// Unit in which footprint areas are summed: this many units are the scene's surface area, so that
// the sum over area_shares is the mean number of footprints over a point.
CONSTANT uint area_shares = 65536u;

ARGAND_SHARED_END

#endif
