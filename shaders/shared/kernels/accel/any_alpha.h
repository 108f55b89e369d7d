// Finds for each ray how much light passes the triangles that it meets: their thickness
// (shared/alpha.h), which `triangle` of a hit holds.
FN void load_result(uint ray, INOUT(HitRecord) hit) { hit.triangle = occluded[ray]; }
FN void store_result(uint ray, HitRecord hit) {
    occluded[ray] = hit.t < real(0.0) ? thickness_of_all : hit.triangle;
}

#define ANY_HIT 1
#define ALPHA 1
