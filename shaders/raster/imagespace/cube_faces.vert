#version 460
// Draws all triangles into the faces of cube maps (Yao et al. 2010, section 3). Instances are
// faces, six for each center.
#include "cube_faces.glsl"

layout(location = 0) flat out uint triangle;
layout(location = 1) flat out uint face_of_all;

void main() {
    triangle = uint(gl_VertexIndex) / 3u;
    uvec4 t = corners[triangle];
    uint corner = uint(gl_VertexIndex) % 3u;
    uint vertex = corner == 0u ? t.x : (corner == 1u ? t.y : t.z);
    face_of_all = uint(gl_InstanceIndex);
    vec3 center = vec3(centers[params.first + face_of_all / 6u]);
    uint face = face_of_all % 6u;
    vec3 place = axis_last(face / 2u, vec3(positions[vertex]) - center);
    gl_Layer = gl_InstanceIndex;
    gl_Position =
        vec4(place.x, place.y, params.nearest, face % 2u == 0u ? place.z : -place.z);
}
