// What both shaders of cube_faces declare.
#extension GL_ARB_shader_viewport_layer_array : require
#include "kernel.glsl"
#include "material_features.glsl"
#include "shared/bsdf.h"
#include "shared/cube_map.h"
#include "shared/image_space_records.h"

layout(set = 0, binding = 0) readonly buffer Positions { vec4 positions[]; };
layout(set = 0, binding = 1) readonly buffer Centers { vec4 centers[]; };
layout(set = 0, binding = 2) readonly buffer Shown { uvec2 shown[]; }; // the layers before this one
#define ALPHA_BINDING 3
#include "alpha_bindings.glsl"
layout(push_constant) uniform Push { CubeDraw params; };
