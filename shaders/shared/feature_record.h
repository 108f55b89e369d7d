#ifndef ARGAND_SHARED_FEATURE_RECORD_H
#define ARGAND_SHARED_FEATURE_RECORD_H

#include "shared/prelude.h"

ARGAND_SHARED_BEGIN

// Sums over the samples of a pixel, of what their rays hit first.
struct FeatureRecord {
    float32 albedo_r, albedo_g, albedo_b, pad0;
    float32 normal_x, normal_y, normal_z, pad1;
};

ARGAND_SHARED_END

#endif
