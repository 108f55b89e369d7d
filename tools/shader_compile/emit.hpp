#pragma once

#include "reflect.hpp"

namespace argand::shader_compile {

/// A kernel as its generated files show it.
struct Kernel {
    std::string name;
    std::string path; ///< of its source, for the documentation
    Reflection interface;
    Spirv spirv; ///< final
    std::string
        twin; ///< the kernel under shaders/cuda/ that other backends run instead; empty: none
};

/// NAME.hpp: the typed binding.
std::string emit_header(const Kernel& kernel);

/// NAME.cpp: the SPIR-V, what is known of it, and checks that host and GPU lay out shared records
/// alike.
std::string emit_source(const Kernel& kernel);

/// twins/NAME.h: what the kernel declares, as the members that its twin in C++ or CUDA works with.
std::string emit_twin(const Kernel& kernel);

/// A depfile in the syntax of make: `outputs` depend on `inputs`.
std::string emit_depfile(const std::vector<std::string>& outputs,
                         const std::vector<std::string>& inputs);

} // namespace argand::shader_compile
