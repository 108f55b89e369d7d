// Arguments and results of the functions under test, in a form that host and device share.
#ifndef ARGAND_TEST_ARGUMENTS_H
#define ARGAND_TEST_ARGUMENTS_H

#include "shared/maths.h"
#include "shared/surface.h"

ARGAND_SHARED_BEGIN

// Single precision in every build, so that the reference computes from the same inputs.
struct Arguments {
    float32 x[32];
};

struct Values {
    real y[16];
};

// Macros, because GLSL would copy all arguments at each call.
#define number_at(a, k) real((a).x[k])
#define vec2_at(a, k) vec2((a).x[k], (a).x[(k) + 1])
#define vec3_at(a, k) vec3((a).x[k], (a).x[(k) + 1], (a).x[(k) + 2])
// A small integer, and a 32-bit integer from its two halves.
#define small_at(a, k) uint((a).x[k])
#define word_at(a, k) ((small_at(a, k) << 16u) | small_at(a, (k) + 1))
// For results whose true value is known independently: evaluates to `found` in the build under test
// and to `truth` in the reference.
#ifdef ARGAND_REAL_DOUBLE
#define must_be(found, truth) ((void)(found), (truth))
#else
#define must_be(found, truth) (found)
#endif

FN void put3(INOUT(Values) r, int k, vec3 v) {
    r.y[k] = v.x;
    r.y[k + 1] = v.y;
    r.y[k + 2] = v.z;
}

// The halves of a word, which single precision holds exactly.
FN void put_word(INOUT(Values) r, int k, uint word) {
    r.y[k] = real(word >> 16u);
    r.y[k + 1] = real(word & 0xffffu);
}

// The triangle whose vertices and normals are the eighteen numbers from k on.
FN SmoothTriangle smooth_triangle_at(IN(Arguments) a, int k) {
    SmoothTriangle t;
    t.v0 = vec3_at(a, k);
    t.v1 = vec3_at(a, k + 3);
    t.v2 = vec3_at(a, k + 6);
    t.n0 = vec3_at(a, k + 9);
    t.n1 = vec3_at(a, k + 12);
    t.n2 = vec3_at(a, k + 15);
    return t;
}

FN Values no_values() {
    Values r;
    for (int k = 0; k < 16; ++k) {
        r.y[k] = real(0.0);
    }
    return r;
}

ARGAND_SHARED_END

#endif
