#pragma once

#include <array>
#include <cstdint>
#include <cstring>
#include <span>
#include <string_view>

namespace argand {

class Buffer;

/// How a kernel uses a buffer; taken from `readonly` and `writeonly` in its source.
enum class Access : std::uint8_t { read, write, read_write };

/// A buffer, or a range of one, as a kernel's argument. It has no default constructor on purpose: a
/// kernel struct that lacks an argument does not compile.
struct BufferView {
    const Buffer* buffer;
    std::uint64_t offset; ///< bytes
    std::uint64_t size;   ///< bytes; 0: to the end

    BufferView(const Buffer& whole)
        : buffer(&whole), offset(0), size(0) {} // NOLINT(google-explicit-constructor)
    BufferView(const Buffer& of, std::uint64_t at, std::uint64_t bytes)
        : buffer(&of), offset(at), size(bytes) {}
};
struct Read : BufferView {
    Read(const BufferView& view) : BufferView(view) {} // NOLINT(google-explicit-constructor)
    Read(const Buffer& whole) : BufferView(whole) {}   // NOLINT(google-explicit-constructor)
};
struct Write : BufferView {
    Write(const BufferView& view) : BufferView(view) {} // NOLINT(google-explicit-constructor)
    Write(const Buffer& whole) : BufferView(whole) {}   // NOLINT(google-explicit-constructor)
};
struct ReadWrite : BufferView {
    ReadWrite(const BufferView& view) : BufferView(view) {} // NOLINT(google-explicit-constructor)
    ReadWrite(const Buffer& whole) : BufferView(whole) {}   // NOLINT(google-explicit-constructor)
};

struct KernelBinding {
    const char* name;
    std::uint32_t binding;
    Access access;
    bool texels = false; ///< read as a utextureBuffer of rgba32ui texels; the buffer's offset is a
                         ///< multiple of 256
    const char* words = "u"; ///< of an element: 'f' for each float, 'u' for each other 32-bit word
};

struct KernelConstant {
    const char* name;
    std::uint32_t id;
};

struct TwinArguments;

/// Runs invocations first <= i < end of a kernel's twin on the host, see device/twin.hpp.
using RunOnHost = void(const TwinArguments& arguments, std::uint64_t first, std::uint64_t end);

/// Launches a kernel's twin on a CUDA stream, on `threads` invocations or as many as `count` in the
/// device's memory says (null: `threads`).
using LaunchOnCuda = void(const TwinArguments& arguments, std::uint64_t threads,
                          const std::uint32_t* count, void* stream);

/// What tools/shader_compile learned of one kernel.
struct KernelInfo {
    const char* name;
    std::span<const std::uint32_t> spirv;
    std::span<const KernelBinding> bindings; ///< in the order of the binding numbers
    std::span<const KernelConstant>
        constants;            ///< specialization constants, in the order of their ids
    std::uint32_t push_bytes; ///< size of the push constants, 0 if none
    std::array<std::uint32_t, 3> local_size;
    bool uses_subgroups;       ///< declares a GroupNonUniform capability beyond Basic
    RunOnHost* host = nullptr; ///< its twins; null: only Vulkan needs the kernel
    LaunchOnCuda* cuda = nullptr;
};

inline constexpr std::size_t max_bindings = 24;
inline constexpr std::size_t max_push_bytes = 128;
inline constexpr std::size_t max_constants = 16;

/// The default of a kernel's push constants: a compile error where it is used (a link error with
/// other compilers).
template <class Params>
#ifdef __GNUC__
[[gnu::error("a kernel lacks its push constants")]]
#endif
Params
missing_push_constants();

/// A kernel's arguments in the form that a backend takes.
struct KernelArguments {
    std::array<const Buffer*, max_bindings> buffers{};
    std::array<std::uint64_t, max_bindings> offsets{};
    std::array<std::uint64_t, max_bindings> sizes{};
    std::uint32_t buffer_count = 0;
    alignas(16) std::array<std::byte, max_push_bytes> push{};
    std::array<std::uint32_t, max_constants> constants{}; ///< bits of each specialization constant
    std::uint32_t constant_count = 0;

    void add(const BufferView& view) {
        buffers[buffer_count] = view.buffer;
        offsets[buffer_count] = view.offset;
        sizes[buffer_count] = view.size;
        ++buffer_count;
    }
    template <class Params> void set_push(const Params& params) {
        static_assert(sizeof(Params) <= max_push_bytes);
        std::memcpy(push.data(), &params, sizeof(Params));
    }
    template <class T> void add_constant(T value) {
        static_assert(sizeof(T) == 4 || sizeof(T) == 1);
        std::uint32_t bits = 0;
        if constexpr (sizeof(T) == 1) {
            bits = value ? 1u : 0u;
        } else {
            std::memcpy(&bits, &value, 4);
        }
        constants[constant_count++] = bits;
    }
};

} // namespace argand
