// Every twin includes this first. A twin is a struct that includes a kernel's body
// (shaders/shared/kernels/): the body's functions are its member functions, and the names that the
// GLSL kernel declares are its members. nvcc compiles it for a GPU, a C++ compiler for the host.
#ifndef ARGAND_CUDA_KERNEL_H
#define ARGAND_CUDA_KERNEL_H

#include "device/twin.hpp"
#include "shared/prelude.h"

// The twins of a kernel's module for plain scenes are other functions and structs of the same
// names.
#ifdef ARGAND_PLAIN
#define ARGAND_TWINS plain_twins
#else
#define ARGAND_TWINS twins
#endif

#define THREAD_INDEX thread_index
// Large arrays that kernels read at random, 16 bytes at a time. GLM's vectors are aligned to 4
// bytes only, so nvcc would not use such loads by itself.
#define NODES(i) read4(nodes, i)
#define PHOTONS(i) read4(photons, i)
#define FOOTPRINTS(i) read4(footprints, i)
#define REFERENCES(i) read4(references, i)
#define TRIANGLES(i) read4(triangles, i)

namespace argand {

#ifdef __CUDA_ARCH__
__device__ inline uvec4 read4(const uvec4* from, uint i) {
    const uint4 v = reinterpret_cast<const uint4*>(from)[i];
    return uvec4(v.x, v.y, v.z, v.w);
}
__device__ inline vec4 read4(const vec4* from, uint i) {
    const float4 v = reinterpret_cast<const float4*>(from)[i];
    return vec4(v.x, v.y, v.z, v.w);
}
#else
template <class T> FN T read4(const T* from, uint i) { return from[i]; }
#endif

#ifdef __CUDA_ARCH__
__device__ inline uint atomicAdd(uint& to, uint value) { return ::atomicAdd(&to, value); }
__device__ inline uint atomicMin(uint& to, uint value) { return ::atomicMin(&to, value); }
__device__ inline uint atomicExchange(uint& to, uint value) { return ::atomicExch(&to, value); }
__device__ inline uint atomicCompSwap(uint& to, uint expected, uint value) {
    return ::atomicCAS(&to, expected, value);
}
#define MEMORY_FENCE() __threadfence()
#else
FN uint atomicAdd(uint& to, uint value) { return __atomic_fetch_add(&to, value, __ATOMIC_ACQ_REL); }
FN uint atomicExchange(uint& to, uint value) {
    return __atomic_exchange_n(&to, value, __ATOMIC_ACQ_REL);
}
FN uint atomicCompSwap(uint& to, uint expected, uint value) {
    __atomic_compare_exchange_n(&to, &expected, value, false, __ATOMIC_ACQ_REL, __ATOMIC_ACQUIRE);
    return expected;
}
FN uint atomicMin(uint& to, uint value) {
    uint old = __atomic_load_n(&to, __ATOMIC_RELAXED);
    while (value < old && !__atomic_compare_exchange_n(&to, &old, value, false, __ATOMIC_ACQ_REL,
                                                       __ATOMIC_RELAXED)) {
    }
    return old;
}
#define MEMORY_FENCE() __atomic_thread_fence(__ATOMIC_ACQ_REL)
#endif

} // namespace argand

// Kernels write the value of a struct as GLSL does, with parentheses. Before version 16 clang takes
// only braces (C++20, P0960). A macro with arguments leaves the struct's name alone elsewhere.
#if defined(__clang__) && __clang_major__ < 16
// clang-format off
#define BoxRecord(...) BoxRecord{__VA_ARGS__}
#define Cell(...) Cell{__VA_ARGS__}
#define EstimateRecord(...) EstimateRecord{__VA_ARGS__}
#define FilmRecord(...) FilmRecord{__VA_ARGS__}
#define FluxLedger(...) FluxLedger{__VA_ARGS__}
#define Footprint(...) Footprint{__VA_ARGS__}
#define ForestCost(...) ForestCost{__VA_ARGS__}
#define FrontierNode(...) FrontierNode{__VA_ARGS__}
#define GatherRecord(...) GatherRecord{__VA_ARGS__}
#define HitRecord(...) HitRecord{__VA_ARGS__}
#define LayersRecord(...) LayersRecord{__VA_ARGS__}
#define LeafSums(...) LeafSums{__VA_ARGS__}
#define Moments(...) Moments{__VA_ARGS__}
#define NearestRecord(...) NearestRecord{__VA_ARGS__}
#define PathRecord(...) PathRecord{__VA_ARGS__}
#define PathVertex(...) PathVertex{__VA_ARGS__}
#define PhotonPathRecord(...) PhotonPathRecord{__VA_ARGS__}
#define PhotonRange(...) PhotonRange{__VA_ARGS__}
#define PhotonRecord(...) PhotonRecord{__VA_ARGS__}
#define PoseBox(...) PoseBox{__VA_ARGS__}
#define QueryRecord(...) QueryRecord{__VA_ARGS__}
#define QueuePathEnd(...) QueuePathEnd{__VA_ARGS__}
#define RayRecord(...) RayRecord{__VA_ARGS__}
#define ShadowRecord(...) ShadowRecord{__VA_ARGS__}
#define EyeWeightRecord(...) EyeWeightRecord{__VA_ARGS__}
#define LightPathRecord(...) LightPathRecord{__VA_ARGS__}
#define SplatRecord(...) SplatRecord{__VA_ARGS__}
#define SegmentRange(...) SegmentRange{__VA_ARGS__}
#define Sum(...) Sum{__VA_ARGS__}
// clang-format on
#endif

#ifdef __CUDACC__

// A grid-stride loop, so that the size of a launch need not match a count that only the device
// knows.
#define ARGAND_TWIN_AS(type, name)                                                                 \
    namespace argand::ARGAND_TWINS {                                                               \
    __global__ void __launch_bounds__(128) name                                                    \
        ##_kernel(const __grid_constant__ type##_arguments arguments, std::uint64_t threads,       \
                  const std::uint32_t* count) {                                                    \
        type kernel{arguments};                                                                    \
        const std::uint64_t end = count != nullptr ? *count : threads;                             \
        for (std::uint64_t i = blockIdx.x * std::uint64_t(blockDim.x) + threadIdx.x; i < end;      \
             i += std::uint64_t(gridDim.x) * blockDim.x) {                                         \
            kernel.thread_index = static_cast<uint>(i);                                            \
            kernel.main();                                                                         \
        }                                                                                          \
    }                                                                                              \
    }                                                                                              \
    namespace argand::kernels {                                                                    \
    LaunchOnCuda cuda_##name;                                                                      \
    void cuda_##name(const TwinArguments& arguments, std::uint64_t threads,                        \
                     const std::uint32_t* count, void* stream) {                                   \
        const std::uint64_t groups = (threads + 127) / 128;                                        \
        ARGAND_TWINS::name##_kernel<<<static_cast<unsigned>(groups < 65536 ? groups : 65536), 128, \
                                      0, static_cast<cudaStream_t>(stream)>>>(                     \
            ARGAND_TWINS::arguments_of(arguments), threads, count);                                \
    }                                                                                              \
    }

#else

#define ARGAND_TWIN_AS(type, name)                                                                 \
    namespace argand::kernels {                                                                    \
    RunOnHost twin_##name;                                                                         \
    void twin_##name(const TwinArguments& arguments, std::uint64_t first, std::uint64_t end) {     \
        ARGAND_TWINS::type kernel{ARGAND_TWINS::arguments_of(arguments)};                          \
        for (std::uint64_t i = first; i < end; ++i) {                                              \
            kernel.thread_index = static_cast<uint>(i);                                            \
            kernel.main();                                                                         \
        }                                                                                          \
    }                                                                                              \
    }

#endif

#define ARGAND_TWIN(name) ARGAND_TWIN_AS(name, name)

#endif
