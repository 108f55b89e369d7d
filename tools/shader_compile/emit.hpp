#pragma once

#include "reflect.hpp"

namespace argand::shader_compile {

/// One of a kernel's lean modules, see device/kernel.hpp.
struct Lean {
    struct Limit {
        std::size_t constant; ///< index among the kernel's specialization constants
        std::string bits;     ///< a C++ literal
    };
    std::string macro; ///< with which it is compiled
    Spirv spirv;       ///< final
    std::vector<Limit> limits;
    bool has_twin = false; ///< NAME.plain.cu
};

/// A kernel, a raster program, or a group of bindings, of which files are generated.
struct Kernel {
    std::string name; ///< of a group: NAME in NAME_bindings.glsl
    std::string path; ///< of its source, for the documentation
    Reflection interface;
    Spirv spirv;      ///< final; a group has none; of a raster program: the vertex shader
    std::string twin; ///< the kernel whose body other backends run; empty: none
    std::vector<Lean> lean = {};
    std::optional<Spirv> fragment = {}; ///< the fragment shader of a raster program
};

/// NAME.hpp: the typed binding.
std::string emit_header(const Kernel& kernel);

/// NAME_bindings.hpp: the structs NameBindings and NameConstants, see group_of().
std::string emit_group(const Kernel& group);

/// NAME.cpp: the SPIR-V, its KernelInfo or RasterInfo, and checks that host and GPU lay out shared
/// records alike.
std::string emit_source(const Kernel& kernel);

/// NAME.twin.h: a struct with what the kernel declares. The kernel's twin derives from it.
std::string emit_twin_header(const Kernel& kernel);

/// NAME.cu: the kernel's twin, for nvcc and for C++ compilers. It is a struct that includes the
/// kernel's body, so that the body's functions are members.
/// body: the header that holds it, as twin_body() returns it.
std::string emit_twin_source(const Kernel& kernel, const std::string& body);

/// The one of the kernel's lean modules that has a twin; null: none.
const Lean* plain_twin(const Kernel& kernel);

/// NAME.plain.cu: the same for the kernel's plain_twin(), as NAME_plain.
std::string emit_plain_twin_source(const Kernel& kernel, const std::string& body);

/// The included header that holds the body of the kernel `twin`: shared/kernels/.../TWIN.h, as C++
/// includes it. Throws Error "file:1: error: ..." if the kernel includes none.
std::string twin_body(const Sources& sources, const std::vector<std::string>& include_directories,
                      const std::string& twin);

/// A depfile in the syntax of make: `outputs` depend on `inputs`.
std::string emit_depfile(const std::vector<std::string>& outputs,
                         const std::vector<std::string>& inputs);

} // namespace argand::shader_compile
