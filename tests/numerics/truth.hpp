#pragma once

#include <array>

/// The functions of functions.h in double precision, behind plain types, because a source file can
/// include only one of both precisions.
namespace argand::truth {

using Inputs = std::array<float, 32>;
using Outputs = std::array<double, 16>;

Outputs evaluate(unsigned function, const Inputs& inputs);

} // namespace argand::truth
