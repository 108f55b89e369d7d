#ifndef ARGAND_SHARED_QUERY_RECORD_H
#define ARGAND_SHARED_QUERY_RECORD_H

#include "shared/prelude.h"

ARGAND_SHARED_BEGIN

// A point at which the photon map is asked for the radiance that estimated lobes scatter towards the eye.
struct QueryRecord {
    float32 x, y, z;
    uint material;
    float32 throughput_r, throughput_g, throughput_b;   // of the path to the eye
    uint direction;         // towards the eye, packed (pack_unit)
    uint geometric_normal;  // towards the eye's side, packed
    uint shading_normal;    // packed
    uint lobes;             // LOBE_* to be estimated
    uint front;             // 1: the surface is seen from its front
};

ARGAND_SHARED_END

#endif
