// Everything under shared/ is written in the common subset of GLSL, CUDA and C++: free functions,
// plain structs, literals written real(0.1). In C++ and CUDA the code lives in namespace argand
// (float) or, if ARGAND_REAL_DOUBLE is defined before the first include, in argand::oracle
// (double): the same text in double precision is the reference for tests. A translation unit uses
// one of the two, never both. Text for plain scenes (ARGAND_PLAIN) has an inline namespace, so that
// the linker does not take its functions for those of other units. Constants that need more than
// one rounding are written out, because glslang folds constant expressions in double precision and
// C++ operation by operation.
#ifndef ARGAND_SHARED_PRELUDE_H
#define ARGAND_SHARED_PRELUDE_H

#ifdef __cplusplus

#include <glm/glm.hpp>

#ifdef __CUDACC__
#define FN __host__ __device__ inline
#else
#define FN inline
#endif
#define IN(T) const T&
#define OUT(T) T&
#define INOUT(T) T&
#define CONSTANT static constexpr
// A constant array that device code can read too.
#ifdef __CUDA_ARCH__
#define TABLE static constexpr __device__
#else
#define TABLE static constexpr
#endif

#ifdef ARGAND_REAL_DOUBLE
#define ARGAND_SHARED_BEGIN                                                                        \
    namespace argand {                                                                             \
    namespace oracle {
#define ARGAND_SHARED_END                                                                          \
    }                                                                                              \
    }
#elif defined(ARGAND_PLAIN)
#define ARGAND_SHARED_BEGIN                                                                        \
    namespace argand {                                                                             \
    inline namespace plain {
#define ARGAND_SHARED_END                                                                          \
    }                                                                                              \
    }
#else
#define ARGAND_SHARED_BEGIN namespace argand {
#define ARGAND_SHARED_END }
#endif

ARGAND_SHARED_BEGIN
#ifdef ARGAND_REAL_DOUBLE
typedef double real;
#else
typedef float real;
#endif
typedef unsigned int uint;
typedef glm::vec<2, real> vec2;
typedef glm::vec<3, real> vec3;
typedef glm::vec<4, real> vec4;
typedef glm::uvec2 uvec2;
typedef glm::uvec3 uvec3;
typedef glm::uvec4 uvec4;
typedef glm::ivec4 ivec4;
typedef glm::bvec3 bvec3;
typedef glm::bvec4 bvec4;
// Fields of records in buffers are single precision whatever `real` is.
typedef float float32;
typedef glm::vec<4, float> lane4;

FN uint float_bits(float x) { return glm::floatBitsToUint(x); }
FN float bits_float(uint x) { return glm::uintBitsToFloat(x); }
FN uvec3 float_bits(const glm::vec3& x) { return glm::floatBitsToUint(x); }
FN glm::vec3 bits_float(const uvec3& x) { return glm::uintBitsToFloat(x); }
FN uvec4 float_bits(const glm::vec4& x) { return glm::floatBitsToUint(x); }
using glm::abs;
using glm::ceil;
using glm::clamp;
using glm::cross;
using glm::dot;
using glm::findMSB;
using glm::floor;
using glm::inversesqrt;
using glm::lessThan;
using glm::lessThanEqual;
using glm::max;
using glm::min;
using glm::mix;
using glm::sqrt;
ARGAND_SHARED_END

#else // GLSL

#define FN
#define IN(T) in T
#define OUT(T) out T
#define INOUT(T) inout T
#define CONSTANT const
#define real float
#define float32 float
#define lane4 vec4
#define float_bits floatBitsToUint
#define bits_float uintBitsToFloat
#define ARGAND_SHARED_BEGIN
#define ARGAND_SHARED_END

#endif

#endif
