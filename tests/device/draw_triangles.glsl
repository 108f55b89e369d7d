// What both shaders of draw_triangles declare.
#extension GL_ARB_shader_viewport_layer_array : require
#include "kernel.glsl"

layout(set = 0, binding = 0) readonly buffer Corners { vec4 corners[]; };
layout(set = 0, binding = 1) readonly buffer Values { uint values[]; };
layout(constant_id = 0) const uint step_of_layers = 0u;
