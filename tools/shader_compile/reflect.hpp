#pragma once

#include "compile.hpp"
#include "device/kernel.hpp"

#include <array>

namespace argand::shader_compile {

struct Member {
    std::string name;
    std::uint32_t offset;       ///< bytes
    std::uint32_t array_stride; ///< bytes; 0: the member is no array
};

/// A GLSL struct that a header under shared/ declares, as the GPU lays it out.
struct Record {
    std::string name;
    std::string header; ///< as C++ includes it: "shared/....h"
    std::uint32_t size; ///< bytes
    std::vector<Member> members;
};

struct Binding {
    std::string name;  ///< of the block's last member
    std::string group; ///< NAME if NAME_bindings.glsl declares it; else empty
    Access access;
    bool texels = false; ///< a utextureBuffer
    std::string type;    ///< of its elements, in C++; "void" if C++ does not see the type
    std::string words;   ///< of an element: 'f' for each float, 'u' for each other 32-bit word

    // From annotations, see annotations.hpp.
    std::string unordered_head;   ///< a C++ expression; empty: the order is fixed
    std::string unordered_stride; ///< a C++ expression
    bool incidental = false;
    int refers_to = -1; ///< number of the binding into which this one has indices
};

struct Constant {
    std::string name;
    std::string group; ///< NAME if NAME_bindings.glsl declares it; else empty
    std::uint32_t id;
    std::string type;  ///< in C++
    std::string value; ///< default, as a C++ literal
};

struct Reflection {
    std::vector<Binding> bindings; ///< at the index of the binding number
    std::optional<Record> push;
    std::string push_name;           ///< of the push constant block's one member
    std::vector<Constant> constants; ///< in the order of their ids
    std::vector<Record> records;     ///< elements of storage buffers that C++ also sees, each once
    /// All included headers under shared/ except shared/kernels/, as C++ includes them.
    std::vector<std::string> headers;
    /// Headers of the constants that annotations name.
    std::vector<std::string> constant_headers;
    std::array<std::uint32_t, 3> local_size; ///< of compute shaders
    bool uses_subgroups;
    std::uint32_t result_words; ///< of the value that a fragment shader writes; else 0
};

/// The NAME of a file NAME_bindings.glsl, empty for other files. What such a file declares is one
/// struct in C++, NameBindings, which the kernels that include the file have as the member NAME;
/// its specialization constants are NameConstants.
std::string group_of(const std::string& path);

/// Reads a kernel's interface from its SPIR-V, which still has names, and its annotations. Throws
/// Error "file:line: error: ..." for an interface that Argand's devices do not support.
/// include_directories: the paths of shared headers in C++ are relative to these. is_group: the
/// file NAME_bindings.glsl is compiled alone, and kernels have other buffers before its own.
Reflection reflect(const Compiled& compiled, const std::vector<std::string>& include_directories,
                   bool is_group = false);

} // namespace argand::shader_compile
