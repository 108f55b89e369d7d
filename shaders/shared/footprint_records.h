#ifndef ARGAND_SHARED_FOOTPRINT_RECORDS_H
#define ARGAND_SHARED_FOOTPRINT_RECORDS_H

#include "shared/prelude.h"

ARGAND_SHARED_BEGIN

// How differentials become footprints, the same for all photons of a pass: make_footprint_scale.
struct FootprintScale {
    float32 spacing; // Δ, by which differentials are divided before they are compressed
    float32 diffuse; // semi-axis [length] = diffuse · (|dp| / spacing)^(1/4)
    float32 caustic; // semi-axis = caustic · |dp|
    float32 radius_min, radius_max;   // [length], of each semi-axis
    float32 caustic_min, caustic_max; // the same of caustic photons
    float32 flatness;    // half-axis along the normal over the geometric mean of the other two
    uint principal_axes; // whether the ellipse's own axes are compressed, not the differentials as
                         // they are
    uint pad0, pad1, pad2;
};

struct FootprintParams {
    FootprintScale scale;
    float32 inverse_surface_area; // of the scene
    float32 least_area_radius;    // of area samples' footprints, so that some overlap everywhere
    uint pad0, pad1;
};

// Of the summed areas of footprints over the scene's surface area, which is the mean number of
// footprints on a point.
CONSTANT uint area_shares = 65536u;

// A sample of the surfaces' area takes the size of its footprint from so many photons on either
// side in the map's order.
CONSTANT uint area_neighbours = 8u;

ARGAND_SHARED_END

#endif
