// Buffers and constants that all estimators share. They define TEXELS (0 or 1) first.
#include "shared/accel_records.h"
#include "shared/compensated.h"
#include "shared/photon.h"
#include "shared/query_bsdf.h"
#include "photon/query_bindings.glsl"
#include "material_features.glsl"

layout(push_constant) uniform Push { PhotonGatherParams params; };
