// Tells for each ray whether it hits any triangle.

// A resumed ray has no result so far.
FN void load_result(uint, INOUT(HitRecord)) {}
FN void store_result(uint ray, HitRecord hit) {
    occluded[ray] = hit.triangle != no_triangle || hit.t < real(0.0) ? 1u : 0u;
}

#define ANY_HIT 1
#define ALPHA 0
