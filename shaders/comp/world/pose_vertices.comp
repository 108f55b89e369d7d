#version 460
layout(local_size_x = 64) in;
#include "kernel.glsl"
#include "shared/pose.h"

layout(set = 0, binding = 0) readonly buffer Vertices { MovingVertex vertices[]; };
layout(set = 0, binding = 1) readonly buffer Joints { VertexJoints joints[]; };
layout(set = 0, binding = 2) readonly buffer Offsets { MorphOffset offsets[]; };
layout(set = 0, binding = 3) readonly buffer Meshes { PosedMesh meshes[]; };
layout(set = 0, binding = 4) readonly buffer Matrices { PoseMatrix matrices[]; };
layout(set = 0, binding = 5) readonly buffer Weights { MorphWeight weights[]; };
layout(set = 0, binding = 6) writeonly buffer Positions { vec4 positions[]; };
layout(set = 0, binding = 7) writeonly buffer Normals { vec4 normals[]; };
layout(push_constant) uniform Push { PoseParams params; };

#include "shared/kernels/world/pose_vertices.h"
