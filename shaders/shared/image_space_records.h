#ifndef ARGAND_SHARED_IMAGE_SPACE_RECORDS_H
#define ARGAND_SHARED_IMAGE_SPACE_RECORDS_H

#include "shared/geometry_records.h"
#include "shared/parallel_records.h"

ARGAND_SHARED_BEGIN

// Layers of the maps around a center where light passes some surfaces: those that it does not pass,
// and the first and the second of the others. Elsewhere there is one layer, the nearest surface.
CONSTANT uint layer_opaque = 0u;
CONSTANT uint layer_first = 1u;
CONSTANT uint layer_second = 2u;
CONSTANT uint most_layers = 3u;

// Directions from the centers of cube maps, numbered through all centers, of which the texels are
// made together.
struct CubeBatch {
    uint first, count;
    uint size;     // texels along the edge of a face
    uint layers;   // 1, or most_layers
    float32 error; // bound of the rounding errors of positions
    uint pad0, pad1, pad2;
};

// A layer of maps that are drawn together.
struct CubeDraw {
    uint first; // number of the first map's center
    uint layer, layers;
    uint size;       // texels along the edge of a face
    float32 nearest; // what is nearer to a center is not drawn
    float32 error;   // bound of the rounding errors of positions
};

// How rays find their hits in cube maps (Yao et al. 2010, section 5).
struct CubeSearch {
    CountRecord count;
    uint centers;
    uint layers; // of maps around each center, one behind another
    uint size;
    uint steps;        // iterations of the root finder
    uint march;        // places at which rays are looked at before; 0: none
    uint exact;        // not 0: hits are those of the texels' triangles; else texels are points
    float32 tolerance; // ε of equation 2, where texels are points
    uint triangles;    // in the scene
    uint at_lights;    // how many of the first centers are point lights
    float32 low_x, low_y, low_z, high_x, high_y, high_z; // a little more than the scene's box
};

// Which surfaces the maps of candidates show that the chosen ones do not.
struct CubeCoverage {
    uint maps; // of candidates
    uint size;
    uint map;             // that has been chosen
    uint bit;             // for it in the masks of the places that it sees
    float32 inverse_unit; // of sums of areas
    uint points;          // to be seen, besides the places that candidates show
    uint pad0, pad1;
};

// Texels of a candidate that one invocation adds up. It divides the texels of maps whose size is
// even.
CONSTANT uint texels_per_area = 24u;

// Bit in the mask of a point: no candidate sees it. The others are those of chosen maps.
CONSTANT uint unseen_by_any = 0x80000000u;

// What is known of a candidate.
struct CubeCandidate {
    uint ignored;             // bits of the chosen maps that do not count: its own
    uint area_low, area_high; // that no other chosen map sees, in units of 1 / inverse_unit
    uint back;                // texels that show a surface from behind
    uint seen;                // texels that show a surface
    uint points;              // that no other chosen map sees
};

ARGAND_SHARED_END

#endif
