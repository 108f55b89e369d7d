#pragma once

#include <nlohmann/json.hpp>
#include <string>

namespace argand::testing {

/// Adds a measurement to a section. Section "tests" gets each test's name and result. After all
/// tests, everything is written as JSON to the file named by ARGAND_NUMERICS_RESULTS, if set;
/// tools/results_numerics turns it into docs/results/numerics.md.
void record_result(const std::string& section, const nlohmann::json& row);

/// Records one extreme situation of a whole pipeline: the expectation and the measurement.
void record_extreme(const std::string& extreme, const std::string& expectation,
                    const std::string& measured);

/// Formats a number as in the document.
std::string shown(double number);

} // namespace argand::testing
