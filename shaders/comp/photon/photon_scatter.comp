#version 460
layout(local_size_x = 64) in;
#include "kernel.glsl"
#include "material_features.glsl"
#include "scene_bindings.glsl"
#include "shared/cone.h"
#include "shared/differential_record.h"
#include "shared/follow.h"
#include "shared/footprint.h"
#include "shared/photon.h"
#include "shared/sampling.h"
#include "texture_bindings.glsl"

layout(set = 0, binding = 10) readonly buffer Hits { HitRecord hits[]; };
layout(set = 0, binding = 11) readonly buffer Active { uint active_slots[]; };
layout(set = 0, binding = 12) buffer Counters { uint counters[]; };
layout(set = 0, binding = 13) buffer Rays { RayRecord rays[]; };
layout(set = 0, binding = 14) buffer Paths { PhotonPathRecord paths[]; };
layout(set = 0, binding = 15) buffer Ledgers { FluxLedger ledgers[]; };
layout(set = 0, binding = 16) writeonly buffer Photons { PhotonRecord photons[]; };
layout(set = 0, binding = 17) writeonly buffer Alive { uint alive[]; };
layout(set = 0, binding = 18) buffer Differentials { DifferentialRecord differentials[]; };
layout(set = 0, binding = 19) writeonly buffer Offsets { uvec4 offsets[]; };
layout(set = 0, binding = 20) readonly buffer PathLights { uint path_lights[]; };
layout(set = 0, binding = 21) writeonly buffer PhotonLights { uint photon_lights[]; };
layout(set = 0, binding = 22) buffer PathVertices { uint path_vertices[]; };
layout(set = 0, binding = 23) writeonly buffer Vertices { PathVertex vertices[]; };
layout(push_constant) uniform Push { PhotonBatch batch; };

layout(constant_id = 0) const uint extents = extents_none; // extents_*
layout(constant_id = 1) const uint reemission = REEMIT_COSINE;
layout(constant_id = 2) const uint numbers = numbers_sobol; // numbers_*
// Whether paths are followed through some lobe of the scene (shared/follow.h); else there are no
// caustics.
layout(constant_id = 3) const bool followed_paths = true;
// Whether some photons are aimed at what is in view.
layout(constant_id = 4) const bool aims_at_view = true;
layout(constant_id = 5) const uint keeps = 0u; // kept_*

#include "shared/kernels/photon/photon_scatter.h"
