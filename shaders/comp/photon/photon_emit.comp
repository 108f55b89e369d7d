#version 460
layout(local_size_x = 64) in;
#include "kernel.glsl"
#include "scene_bindings.glsl"
#include "shared/aim.h"
#include "shared/differential_record.h"
#include "shared/light_differential.h"
#include "shared/lights.h"
#include "shared/photon.h"
#include "shared/sampling.h"
#include "shared/sky.h"
#include "texture_bindings.glsl"

layout(set = 0, binding = 10) writeonly buffer Rays { RayRecord rays[]; };
layout(set = 0, binding = 11) writeonly buffer Photons { PhotonPathRecord paths[]; };
layout(set = 0, binding = 12) writeonly buffer Ledgers { FluxLedger ledgers[]; };
layout(set = 0, binding = 13) writeonly buffer Active { uint active_slots[]; };
layout(set = 0, binding = 14) writeonly buffer Differentials {
    DifferentialRecord differentials[];
};
layout(set = 0, binding = 15) readonly buffer Aims { AimNode aim_nodes[]; };
layout(set = 0, binding = 16) readonly buffer Sky { uint sky[]; };
layout(set = 0, binding = 17) writeonly buffer PathLights { uint path_lights[]; };
layout(set = 0, binding = 18) writeonly buffer PathVertices { uint path_vertices[]; };
layout(set = 0, binding = 19) writeonly buffer Vertices { PathVertex vertices[]; };
layout(set = 0, binding = 20) writeonly buffer Hits { HitRecord hits[]; };
layout(push_constant) uniform Push { PhotonBatch batch; };

// Whether photons carry differentials.
layout(constant_id = 0) const bool footprints = false;
layout(constant_id = 1) const uint numbers = numbers_sobol; // numbers_*

layout(constant_id = 2) const uint keeps = 0u; // kept_*

#include "shared/kernels/photon/photon_emit.h"
