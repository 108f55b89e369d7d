// The buffers of the kernels that read cube maps: texels and centers, and the scene's triangles. A
// kernel's own buffers begin at binding 4.
layout(set = 0, binding = 0) readonly buffer MapTexels { uvec2 map_texels[]; };
layout(set = 0, binding = 1) readonly buffer Centers { vec4 centers[]; };
layout(set = 0, binding = 2) readonly buffer Positions { vec4 positions[]; };
layout(set = 0, binding = 3) readonly buffer Triangles { uvec4 triangles[]; };
