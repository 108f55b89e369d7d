#version 460
layout(local_size_x = 64) in;
#include "kernel.glsl"
#include "shared/cube_map.h"
#include "shared/frame.h"
#include "shared/image_space_records.h"

layout(set = 0, binding = 0) readonly buffer MapTexels { uvec2 map_texels[]; };
layout(set = 0, binding = 1) readonly buffer Centers { vec4 centers[]; };
layout(set = 0, binding = 2) readonly buffer Positions { vec4 positions[]; };
layout(set = 0, binding = 3) readonly buffer Triangles { uvec4 triangles[]; };
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
