#version 460
// The vertices of Dear ImGui's lists, in pixels.
layout(location = 0) in vec2 position;
layout(location = 1) in vec2 uv;
layout(location = 2) in vec4 color;
layout(push_constant) uniform Push {
    vec2 scale;
    vec2 offset;
};
layout(location = 0) out vec4 out_color;
layout(location = 1) out vec2 out_uv;

void main() {
    out_color = color;
    out_uv = uv;
    gl_Position = vec4(position * scale + offset, 0.0, 1.0);
}
