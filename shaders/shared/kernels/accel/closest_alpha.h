// Finds the closest hit of each ray on what is present of the triangles, or the closest behind the
// hit that the ray has passed.
FN void load_result(uint ray, OUT(HitRecord) hit) {
    uvec4 record = hits[ray];
    hit = HitRecord(record.x, bits_float(record.y), bits_float(record.z), bits_float(record.w));
}
FN void store_result(uint ray, HitRecord hit) {
    hits[ray] = uvec4(hit.triangle, float_bits(hit.t), float_bits(hit.u), float_bits(hit.v));
}

#define ANY_HIT 0
#define ALPHA 1
