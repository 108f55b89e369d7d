#include "shared/geometry_records.h"

layout(set = 0, binding = 7) writeonly buffer Occluded { uint occluded[]; };

// Nothing is known yet of a ray that goes on.
void load_result(uint ray, inout HitRecord hit) {}
void store_result(uint ray, HitRecord hit) { occluded[ray] = hit.triangle != no_triangle || hit.t < 0.0 ? 1u : 0u; }

#define ANY_HIT 1
#include "accel/traverse.glsl"
