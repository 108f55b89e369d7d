// Records of the kernels that find covered photons (engine/photon/covered.hpp).
#ifndef ARGAND_SHARED_COVER_RECORDS_H
#define ARGAND_SHARED_COVER_RECORDS_H

#include "shared/prelude.h"

ARGAND_SHARED_BEGIN

// Short rays to photons.
struct PhotonCoverParams {
    uint first, count; // slots of this batch
    uint counter;      // that holds the number of active rays
    float32 height;    // at which the rays start
    float32 error;     // bound of the rounding errors of positions
    // Only photons within this distance of this point are tested: area samples surround them.
    float32 corrected_x, corrected_y, corrected_z, corrected_distance;
};

ARGAND_SHARED_END

#endif
