// What all estimators read and write.
#include "photon/map_walk.glsl"
#include "material_features.glsl"
#include "shared/compensated.h"
#include "shared/query_bsdf.h"

layout(set = 0, binding = 3) readonly buffer Active { uint active_slots[]; };
layout(set = 0, binding = 4) readonly buffer Counts { uint counts[]; };
layout(set = 0, binding = 5) readonly buffer Queries { QueryRecord queries[]; };
layout(set = 0, binding = 6) readonly buffer QueryBsdfs { QueryBsdfRecord query_bsdfs[]; };
layout(set = 0, binding = 8) buffer Unfinished { uint unfinished[]; };
layout(set = 0, binding = 9) writeonly buffer Estimates { EstimateRecord estimates[]; };
layout(push_constant) uniform Push { PhotonGatherParams params; };

// Whether any estimated lobe of the scene is not Lambertian; else `query_bsdfs` is not read.
layout(constant_id = 0) const bool glossy = true;
// Whether queries limit the scatterings of photons that count (final gather, query_record.h).
layout(constant_id = 2) const bool final_gather = false;
// Whether there may be caustic photons.
layout(constant_id = 3) const bool caustics = true;
