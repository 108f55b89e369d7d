#pragma once

#include "sources.hpp"

#include <cstdint>

namespace argand::shader_compile {

using Spirv = std::vector<std::uint32_t>;

struct Compiled {
    Spirv spirv; ///< SPIR-V 1.5 as glslang writes it: with names, not optimised
    Sources sources;
    std::string warnings; ///< lines "file:line: warning: ...", empty if there are none
};

/// Compiles a GLSL compute shader for Vulkan 1.2. Throws Error "file:line: error: ...".
Compiled compile(const std::string& kernel, const std::vector<std::string>& include_directories);

/// The same for the text of a kernel that `path` would hold.
Compiled compile_text(const std::string& path, const std::string& text,
                      const std::vector<std::string>& include_directories);

} // namespace argand::shader_compile
