#version 460
layout(local_size_x = 64) in;
#include "kernel.glsl"
#include "scene_bindings.glsl"
#include "material_features.glsl"
#include "texture_bindings.glsl"
#include "shared/follow.h"
#include "shared/light_path.h"
#include "shared/light_path_records.h"
#include "shared/photon_records.h"
#include "shared/random.h"
#include "shared/sky.h"

layout(set = 0, binding = 10) readonly buffer Hits { HitRecord hits[]; };
layout(set = 0, binding = 11) readonly buffer Active { uint active_slots[]; };
layout(set = 0, binding = 12) readonly buffer Counters { uint counters[]; };
layout(set = 0, binding = 13) readonly buffer Rays { RayRecord rays[]; };
layout(set = 0, binding = 14) readonly buffer Paths { PhotonPathRecord paths[]; };
layout(set = 0, binding = 15) readonly buffer PathLights { uint path_lights[]; };
layout(set = 0, binding = 16) buffer LightPaths { LightPathRecord light_paths[]; };
layout(set = 0, binding = 17) readonly buffer Cameras { CameraRecord camera[]; };
layout(set = 0, binding = 18) writeonly buffer ShadowRays { RayRecord shadow_rays[]; };
layout(set = 0, binding = 19) writeonly buffer Splats { SplatRecord splats[]; };
layout(set = 0, binding = 20) readonly buffer Sky { uint sky[]; };
layout(push_constant) uniform Push { ConnectParams params; };

// Whether some surface has followed lobes.
layout(constant_id = 0) const bool followed_paths = true;

#include "shared/kernels/methods/connect_photons.h"
