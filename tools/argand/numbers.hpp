#pragma once

#include <CLI/CLI.hpp>

#include <cstdint>

namespace argand {

/// Accepts decimal integers in [low, high]. Anything else is a usage error that names the range.
CLI::Validator integer_between(std::uint64_t low, std::uint64_t high);

/// Accepts decimal numbers in [low, high], so neither not-a-number nor infinity.
CLI::Validator number_between(double low, double high);

} // namespace argand
