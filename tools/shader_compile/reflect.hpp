#pragma once

#include "compile.hpp"
#include "device/kernel.hpp"

#include <array>

namespace argand::shader_compile {

struct Member {
    std::string name;
    std::uint32_t offset;       ///< bytes
    std::uint32_t array_stride; ///< bytes, 0 if it is not an array
};

/// A GLSL struct that a header under shared/ declares, as the GPU lays it out.
struct Record {
    std::string name;
    std::string header; ///< as C++ includes it: "shared/....h"
    std::uint32_t size; ///< bytes
    std::vector<Member> members;
};

struct Binding {
    std::string name; ///< of the block's last member
    Access access;
    bool texels = false; ///< a utextureBuffer
    std::string type;    ///< of its elements, in C++; "void" if C++ does not see the type
    std::string words;   ///< of an element: 'f' for each float, 'u' for each other 32-bit word
};

struct Constant {
    std::string name;
    std::uint32_t id;
    std::string type;  ///< in C++
    std::string value; ///< default, as a C++ literal
};

struct Reflection {
    std::vector<Binding> bindings; ///< at the index of the binding number
    std::optional<Record> push;
    std::string push_name;           ///< of the push constant block's one member
    std::vector<Constant> constants; ///< in the order of their ids
    std::vector<Record> records; ///< elements of the storage buffers that C++ sees too, each once
    std::vector<std::string>
        headers; ///< all included headers under shared/, as C++ includes them, but shared/kernels/
    std::array<std::uint32_t, 3> local_size;
    bool uses_subgroups;
};

/// Reads the interface of a kernel from its SPIR-V (with names). `include_directories`: how the
/// shared headers' paths become what C++ includes. Throws Error "file:line: error: ..." for what
/// Argand's devices do not take.
Reflection reflect(const Compiled& compiled, const std::vector<std::string>& include_directories);

} // namespace argand::shader_compile
