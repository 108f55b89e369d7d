#pragma once

#include "sources.hpp"

#include <array>
#include <cstdint>

namespace argand::shader_compile {

using Spirv = std::vector<std::uint32_t>;

inline constexpr std::size_t header_words = 5; ///< before the first instruction of a module

struct Compiled {
    Spirv spirv; ///< SPIR-V 1.5 as glslang writes it: with names, not optimised
    Sources sources;
    std::string warnings; ///< lines "file:line: warning: ...", empty if there are none
};

/// Each is defined while a lean module of a kernel is compiled, see device/kernel.hpp: the one with
/// the least code first.
inline constexpr std::array lean_macros{"ARGAND_PLAIN", "ARGAND_LEAN"};

/// Compiles a GLSL shader for Vulkan 1.2: a vertex shader if the path ends in .vert, a fragment
/// shader if it ends in .frag, else a compute shader. macro: is defined; empty: none. Throws Error
/// "file:line: error: ...".
Compiled compile(const std::string& kernel, const std::vector<std::string>& include_directories,
                 const std::string& macro = "");

/// The same for the text of a kernel that `path` would hold.
Compiled compile_text(const std::string& path, const std::string& text,
                      const std::vector<std::string>& include_directories,
                      const std::string& macro = "");

} // namespace argand::shader_compile
