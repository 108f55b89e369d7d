// The buffers of the kernels that answer queries: the photon map, the queries, their estimates.
// With TEXELS they read the map through texture units, which is faster on CPUs. A kernel's own
// buffers begin at binding 9.
#include "shared/query_record.h"

#if TEXELS
layout(set = 0, binding = 0) uniform utextureBuffer nodes;
layout(set = 0, binding = 1) uniform utextureBuffer photons;
#define NODES(i) texelFetch(nodes, int(i))
#define PHOTONS(i) texelFetch(photons, int(i))
#else
layout(set = 0, binding = 0) readonly buffer Nodes { uvec4 nodes[]; };
layout(set = 0, binding = 1) readonly buffer Photons { uvec4 photons[]; };
#define NODES(i) nodes[i]
#define PHOTONS(i) photons[i]
#endif
layout(set = 0, binding = 2) readonly buffer Counters { uint counters[]; };
layout(set = 0, binding = 3) readonly buffer Active { uint active_slots[]; };
layout(set = 0, binding = 4) readonly buffer Counts { uint counts[]; };
layout(set = 0, binding = 5) readonly buffer Queries { QueryRecord queries[]; };
layout(set = 0, binding = 6) readonly buffer QueryBsdfs { QueryBsdfRecord query_bsdfs[]; };
layout(set = 0, binding = 7) buffer Unfinished { uint unfinished[]; };
layout(set = 0, binding = 8) writeonly buffer Estimates { EstimateRecord estimates[]; };

// Whether any estimated lobe of the scene is not Lambertian; else `query_bsdfs` is not read.
layout(constant_id = 0) const bool glossy = true;
// Whether queries limit the scatterings of photons that count (query_gathers, query_record.h).
layout(constant_id = 2) const bool limits_scatterings = false;
// Whether there may be caustic photons.
layout(constant_id = 3) const bool caustics = true;
