// The buffers of the kernels that add the photons of leaves to their queries (frontier_records.h).
// A kernel's own buffers begin at binding 8.
#include "shared/frontier_records.h"
#include "shared/photon_records.h"
#include "shared/query_record.h"

#if TEXELS
layout(set = 0, binding = 0) uniform utextureBuffer photons;
#define PHOTONS(i) texelFetch(photons, int(i))
#else
layout(set = 0, binding = 0) readonly buffer Photons { uvec4 photons[]; };
#define PHOTONS(i) photons[i]
#endif
layout(set = 0, binding = 1) readonly buffer Queries { QueryRecord queries[]; };
layout(set = 0, binding = 2) readonly buffer QueryBsdfs { QueryBsdfRecord query_bsdfs[]; };
layout(set = 0, binding = 3) buffer Gathers { GatherRecord gathers[]; };
layout(set = 0, binding = 4) readonly buffer Places { uvec4 places[]; };
layout(set = 0, binding = 5) readonly buffer Segments { uint segments[]; };
layout(set = 0, binding = 6) readonly buffer Nodes { FrontierNode frontier[]; };
#if TEXELS
layout(set = 0, binding = 7) uniform utextureBuffer references;
#define REFERENCES(i) texelFetch(references, int(i))
#else
layout(set = 0, binding = 7) readonly buffer References { uvec4 references[]; };
#define REFERENCES(i) references[i]
#endif

// Whether any estimated lobe of the scene is not Lambertian; else `query_bsdfs` is not read.
layout(constant_id = 0) const bool glossy = true;
// Whether queries limit the scatterings of photons that count (query_gathers, query_record.h).
layout(constant_id = 2) const bool limits_scatterings = false;
// Whether there may be caustic photons.
layout(constant_id = 3) const bool caustics = true;
