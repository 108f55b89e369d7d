#pragma once

#include <nlohmann/json.hpp>
#include <string>

namespace argand::testing {

/// What tests measured, by section, and "tests": each one's name and whether it passed. Written as
/// JSON to the file that ARGAND_NUMERICS_RESULTS names, if any, when the tests have run;
/// tools/results_numerics makes docs/results/numerics.md of it.
void record_result(const std::string& section, const nlohmann::json& row);

/// One extreme of a whole pipeline: what is expected and what was measured.
void record_extreme(const std::string& extreme, const std::string& expectation,
                    const std::string& measured);

/// As the document shows numbers.
std::string shown(double number);

} // namespace argand::testing
