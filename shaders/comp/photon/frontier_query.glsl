// Buffers and constants of the kernels that add leaves. They define TEXELS (0 or 1) first.
#include "shared/compensated.h"
#include "shared/photon.h"
#include "shared/photon_records.h"
#include "shared/query_bsdf.h"
#include "shared/segments.h"
#include "photon/frontier_bindings.glsl"
#include "material_features.glsl"

layout(push_constant) uniform Push { FrontierGatherParams params; };
