#pragma once

#include "sweep/measurement.hpp"

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace argand {

/// A setting that could not be rendered, for want of memory say.
struct Failure {
    std::string options; ///< of `argand render`
    std::string why;
};

/// What is known of one scene, in one size, on one device, against one reference.
struct Results {
    nlohmann::ordered_json run;            ///< what it is of: another is not gone on with
    std::uint64_t reference_samples = 0;   ///< per pixel; 0: not known
    std::optional<double> reference_error; ///< Reference::own_error
    double least_error = rounding_error;   ///< least_error_of the reference
    LearntWidths learnt;
    std::vector<Measurement> measurements;
    std::vector<Failure> failures; ///< of the last run; they are tried again in the next one
    bool complete = false;         ///< nothing of the sweep is missing but these
};

nlohmann::ordered_json to_json(const Results& results);
/// Reads what was written as JSON. Error if the file is no such thing.
Results read_results(const std::filesystem::path& file);

/// The mean relMSE as it is compared and drawn: what is below `least_error`, 0 or less included,
/// counts as that. Infinity if it is not finite.
double counted_error(const Results& results, const Measurement& measurement);

/// Indices of the measurements on the Pareto front of median wall time and counted error, the
/// quickest first.
std::vector<std::size_t> front_of(const Results& results);

/// One line for each measurement below one that names the columns; what is not known or not finite
/// is empty. Errors are as they were measured.
std::string to_csv(const Results& results);

} // namespace argand
