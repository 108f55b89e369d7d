#pragma once

#include "reflect.hpp"

namespace argand::shader_compile {

/// A kernel as its generated files show it.
struct Kernel {
    std::string name;
    std::string path; ///< of its source, for the documentation
    Reflection interface;
    Spirv spirv;      ///< final
    std::string twin; ///< the kernel whose text other backends run instead; empty: none
};

/// NAME.hpp: the typed binding.
std::string emit_header(const Kernel& kernel);

/// NAME.cpp: the SPIR-V, what is known of it, and checks that host and GPU lay out shared records
/// alike.
std::string emit_source(const Kernel& kernel);

/// NAME.twin.h: a struct with what the kernel declares. The kernel's twin derives from it.
std::string emit_twin_header(const Kernel& kernel);

/// NAME.cu: the kernel's twin, for nvcc and for C++ compilers. It is a struct that includes the
/// kernel's text, so that the text's functions are members.
/// text: the header that holds it, as twin_text() returns it.
std::string emit_twin_source(const Kernel& kernel, const std::string& text);

/// The included header that holds the text of the kernel `twin`: shared/kernels/.../TWIN.h, as C++
/// includes it. Throws Error "file:1: error: ..." if the kernel includes none.
std::string twin_text(const Sources& sources, const std::vector<std::string>& include_directories,
                      const std::string& twin);

/// A depfile in the syntax of make: `outputs` depend on `inputs`.
std::string emit_depfile(const std::vector<std::string>& outputs,
                         const std::vector<std::string>& inputs);

} // namespace argand::shader_compile
