#include "shared/geometry_records.h"

layout(set = 0, binding = 7) buffer Hits { uvec4 hits[]; };

void load_result(uint ray, out HitRecord hit) {
    uvec4 record = hits[ray];
    hit = HitRecord(record.x, uintBitsToFloat(record.y), uintBitsToFloat(record.z), uintBitsToFloat(record.w));
}
void store_result(uint ray, HitRecord hit) {
    hits[ray] = uvec4(hit.triangle, floatBitsToUint(hit.t), floatBitsToUint(hit.u), floatBitsToUint(hit.v));
}

#define ANY_HIT 0
#include "accel/traverse.glsl"
