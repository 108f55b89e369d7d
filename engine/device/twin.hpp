#pragma once

#include "device/kernel.hpp"

#include <cstddef>
#include <cstdint>
#include <cstring>

namespace argand {

/// A kernel's arguments as its twin takes them: pointers that the backend has resolved, push
/// constants as bytes, and specialization constants as bits, in the order of their ids.
struct TwinArguments {
    void* buffers[max_bindings];
    std::byte push[max_push_bytes];
    std::uint32_t constants[max_constants];

    template <class Params> void get_push(Params& params) const {
        static_assert(sizeof(Params) <= max_push_bytes);
        std::memcpy(&params, push, sizeof(Params));
    }
    void get_constant(std::size_t index, bool& value) const { value = constants[index] != 0; }
    template <class T> void get_constant(std::size_t index, T& value) const {
        static_assert(sizeof(T) == sizeof(std::uint32_t));
        std::memcpy(&value, &constants[index], sizeof(T));
    }
};

/// Bytes of the largest buffer that a twin can use: its body indexes words with 32 bits.
inline constexpr std::uint64_t most_addressable = std::uint64_t(4) << 30;

/// Throws Error if 32 bits cannot number a kernel's invocations.
void check_threads(const KernelInfo& kernel, std::uint64_t threads);

} // namespace argand
