#version 460
#include "draw_triangles.glsl"

layout(location = 0) flat out uint value;

void main() {
    value = values[gl_VertexIndex / 3] + step_of_layers * uint(gl_InstanceIndex);
    gl_Position = corners[gl_VertexIndex];
    gl_Layer = gl_InstanceIndex;
}
