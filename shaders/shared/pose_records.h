#ifndef ARGAND_SHARED_POSE_RECORDS_H
#define ARGAND_SHARED_POSE_RECORDS_H

#include "shared/prelude.h"

ARGAND_SHARED_BEGIN

// A vertex of a moving mesh in object space. Vertices of one mesh follow each other.
struct MovingVertex {
    float32 x, y, z;
    uint mesh; // index of its PosedMesh
    float32 normal_x, normal_y, normal_z;
    uint is_used; // by a triangle; else 0
};

// The joints that carry a vertex: indices into the matrices of all skins and nodes, and weights.
struct VertexJoints {
    uvec4 matrices;
    lane4 weights;
};

// What a morph target adds to a vertex, times its weight.
struct MorphOffset {
    float32 x, y, z, pad0;
    float32 normal_x, normal_y, normal_z, pad1;
};

CONSTANT uint no_joints = 0xffffffffu;

// Where the parts of a moving mesh lie in memory. Offset of vertex v by target t of a mesh with n
// vertices: first_offset + t n + v.
struct PosedMesh {
    uint first_vertex;        // of the scene
    uint first_moving_vertex; // of all moving meshes
    uint vertices;
    uint matrix;       // of the node; unused if the mesh has joints
    uint first_joints; // no_joints: the node carries the mesh
    uint first_weight;
    uint targets;
    uint first_offset;
};

// The rows of a transform to world space, as sums of a single-precision number and its remainder,
// and those of its normals' transform (up to a positive factor), which joints do not have.
struct PoseMatrix {
    lane4 high_x, high_y, high_z;
    lane4 low_x, low_y, low_z;
    lane4 normal_x, normal_y, normal_z;
};

// The weight of a morph target: a sum.
struct MorphWeight {
    float32 high, low;
};

struct PoseParams {
    uint vertices; // of all moving meshes
    uint with_normals;
};

// Vertices of a moving mesh, of which one invocation finds the box.
struct PosePart {
    uint mesh, first_vertex, first_moving_vertex, vertices;
};
// Few enough for lavapipe's loops.
CONSTANT uint most_vertices_of_part = 512u;

// The box of a part's vertices; low > high for none. Vertices that are not finite are counted
// instead, those that no triangle uses included.
struct PoseBox {
    float32 low_x, low_y, low_z;
    uint not_finite;
    float32 high_x, high_y, high_z;
    uint pad;
};

struct PoseBoxParams {
    uint parts;
};

ARGAND_SHARED_END

#endif
