#pragma once

#include "compile.hpp"

namespace argand::shader_compile {

/// Decorates the result of every floating-point operation with NoContraction (SPIR-V
/// specification, 3.20), so that no driver fuses a multiplication with an addition and all devices
/// round alike.
Spirv forbid_contraction(const Spirv& spirv);

} // namespace argand::shader_compile
