#ifndef ARGAND_SHARED_GEOMETRY_RECORDS_H
#define ARGAND_SHARED_GEOMETRY_RECORDS_H

#include "shared/prelude.h"

ARGAND_SHARED_BEGIN

// Records in storage buffers are laid out in 16-byte lanes, so that std430, C++ and CUDA agree.

struct BoxRecord {
    float32 low_x, low_y, low_z, pad0;
    float32 high_x, high_y, high_z, pad1;
};

// t_max of unbounded rays. Traversal reserves larger numbers for itself.
CONSTANT float32 far_away = float32(1.0e30);
// t_max of unbounded rays that go on behind their last hit, which the results still hold. Hits at
// the same distance on triangles that come later in the scene lie behind it.
CONSTANT float32 goes_on = float32(2.0e30);
// Whether a ray goes on behind its last hit. The least bits of t_max belong to the path (medium.h).
FN bool goes_on_behind_hit(float32 t_max) { return t_max >= goes_on && t_max < float32(3.0e30); }

// A ray with 0 <= t <= t_max. t_max < 0: the slot holds no ray.
struct RayRecord {
    float32 origin_x, origin_y, origin_z, t_max;
    float32 direction_x, direction_y, direction_z;
    uint cone; // width and spread of a path (ray_cone.h); 0: it has none
};

CONSTANT uint no_triangle = 0xffffffffu;

// The hit of a ray: the triangle's index in the scene (no_triangle: a miss), the distance in units
// of the ray's direction, and the barycentric weights of the second and third vertex.
struct HitRecord {
    uint triangle;
    float32 t, u, v;
};

// t of the hits that photons leave when they are emitted: on the light's triangle; no_triangle: it
// has none.
CONSTANT float32 start_of_path = float32(-1.0);
// u of a miss: the ray leaves the scene, or what was searched does not show its hit.
CONSTANT float32 ray_escaped = float32(0.0);
CONSTANT float32 ray_lost = float32(1.0);

// Hits lie one behind another by distance, and at one distance by their order in the scene.
FN bool comes_before(HitRecord a, HitRecord b) {
    return a.t < b.t || (a.t == b.t && a.triangle < b.triangle);
}

ARGAND_SHARED_END

#endif
