#pragma once

#include "compile.hpp"

#include <set>

namespace argand::shader_compile {

/// Turns the boolean specialization constants with these ids into constants of their defaults, so
/// that the optimiser removes what depends on them.
Spirv fix_constants(const Spirv& spirv, const std::set<std::uint32_t>& ids);

} // namespace argand::shader_compile
