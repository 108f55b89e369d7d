#version 460
layout(local_size_x = 64) in;
#include "kernel.glsl"
#include "scene_bindings.glsl"
#include "material_features.glsl"
#include "texture_bindings.glsl"
#include "shared/close_light.h"
#include "shared/follow.h"
#include "shared/light_path.h"
#include "shared/light_path_records.h"
#include "shared/photon.h"
#include "shared/query_cell.h"
#include "shared/query_bsdf.h"
#include "shared/sampling.h"
#include "shared/sky.h"

layout(set = 0, binding = 10) readonly buffer Hits { HitRecord hits[]; };
layout(set = 0, binding = 11) readonly buffer Active { uint active_slots[]; };
layout(set = 0, binding = 12) readonly buffer Counts { uint counts[]; };
layout(set = 0, binding = 13) buffer Rays { RayRecord rays[]; };
layout(set = 0, binding = 14) buffer Paths { PathRecord paths[]; };
layout(set = 0, binding = 15) buffer Layers { LayersRecord layers[]; };
layout(set = 0, binding = 16) writeonly buffer ShadowRays { RayRecord shadow_rays[]; };
layout(set = 0, binding = 17) writeonly buffer Shadows { ShadowRecord shadows[]; };
layout(set = 0, binding = 18) writeonly buffer Queries { QueryRecord queries[]; };
layout(set = 0, binding = 19) writeonly buffer Alive { uint alive[]; };
layout(set = 0, binding = 20) writeonly buffer QueryKinds { uint query_kinds[]; };
layout(set = 0, binding = 21) writeonly buffer QueryBsdfs { QueryBsdfRecord query_bsdfs[]; };
layout(set = 0, binding = 22) readonly buffer Sky { uint sky[]; };
layout(set = 0, binding = 23) buffer EyeWeights { EyeWeightRecord eye_weights[]; };
layout(push_constant) uniform Push { EyeBatch batch; };

// false: a path tracer. true: the photon map provides the light that estimated lobes scatter more than once.
layout(constant_id = 0) const bool photon_map = false;
layout(constant_id = 1) const uint variant = variant_plain; // variant_*
// Whether some surface has followed lobes; else there are no caustics.
layout(constant_id = 2) const bool followed_paths = true;
// Whether lights are sampled; else there are no shadow rays.
layout(constant_id = 3) const bool direct_light = true;
// Whether queries may be on surfaces that are not Lambertian; else `query_bsdfs` is not written.
layout(constant_id = 4) const bool glossy_estimates = true;
// Whether numbers are points of a lattice.
layout(constant_id = 5) const bool lattice = false;

#include "shared/kernels/methods/eye_vertex.h"
