#pragma once

#include "compile.hpp"

namespace argand::shader_compile {

/// Runs spirv-opt's performance passes and strips the names. Forbids contraction both before, so
/// that the passes do not reassociate, and after. Throws Error that names the kernel if SPIRV-Tools
/// fails.
Spirv optimise(const Spirv& spirv, const std::string& kernel);

/// Throws Error with the validator's message if the module is not valid for Vulkan 1.2.
void validate(const Spirv& spirv, const std::string& kernel);

} // namespace argand::shader_compile
