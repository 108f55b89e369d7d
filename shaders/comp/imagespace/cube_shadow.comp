#version 460
layout(local_size_x = 64) in;
#include "kernel.glsl"
#include "imagespace/cube_bindings.glsl"
#include "shared/cube_map.h"
#include "shared/frame.h"
#include "shared/image_space_records.h"

layout(set = 0, binding = 4) readonly buffer Rays { RayRecord rays[]; };
layout(set = 0, binding = 5) readonly buffer Active { uint active_rays[]; };
layout(set = 0, binding = 6) readonly buffer Counts { uint counts[]; };
layout(set = 0, binding = 7) readonly buffer Hits { HitRecord hits[]; }; // that the rays leave
layout(set = 0, binding = 8) writeonly buffer Occluded { uint occluded[]; };
#define ALPHA_BINDING 9
#include "alpha_bindings.glsl"
layout(push_constant) uniform Push { CubeSearch params; };
// Whether parts of surfaces are absent.
layout(constant_id = 0) const bool has_alpha = true;

#include "shared/kernels/imagespace/cube_shadow.h"
