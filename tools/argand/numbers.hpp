#pragma once

#include <CLI/CLI.hpp>

#include <cstdint>

namespace argand {

/// Accepts decimal integers of [low, high]; anything else is a usage error that names the range.
CLI::Validator integer_between(std::uint64_t low, std::uint64_t high);

/// Accepts decimal numbers of [low, high], which not-a-number and infinity never are.
CLI::Validator number_between(double low, double high);

} // namespace argand
