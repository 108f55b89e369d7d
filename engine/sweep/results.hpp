#pragma once

#include "sweep/measurement.hpp"

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace argand {

/// A setting that could not be rendered, for example because memory ran out.
struct Failure {
    std::string options; ///< of `argand render`
    std::string why;
};

/// The results of a sweep of one scene at one size, on one device, against one reference.
// The check takes an assertion in nlohmann::json's moves for an exception.
// NOLINTNEXTLINE(bugprone-exception-escape)
struct Results {
    nlohmann::ordered_json run;          ///< what was measured; a sweep resumes only if it is equal
    std::string reference_method;        ///< of a reference that was rendered
    bool reference_is_blind = false;     ///< is_blind_to_caustics() of its scene
    std::uint64_t reference_samples = 0; ///< per pixel; 0: unknown
    std::optional<double> reference_error; ///< Reference::own_error
    double least_error = rounding_error;   ///< least_error_of the reference
    LearntBandwidths learnt;               ///< the bandwidths that each method chose
    std::vector<Measurement> measurements;
    std::vector<Failure> failures; ///< in the last run; the next one tries them again
    bool complete = false;         ///< all settings are measured, except those that failed
};

nlohmann::ordered_json to_json(const Results& results);
/// Reads results that were written as JSON. Throws Error if the file holds anything else.
Results read_results(const std::filesystem::path& file);

/// The mean relMSE as it is compared and drawn: at least `least_error`, even where the measured one
/// is 0 or negative. Infinity if the measured one is not finite.
double clamped_error(const Results& results, const Measurement& measurement);

/// Indices of the measurements on the Pareto front of median wall time and clamped error, fastest
/// first.
std::vector<std::size_t> front_of(const Results& results);

/// A line that names the columns, then a line for each measurement. Values that are unknown or not
/// finite are empty. Errors are not clamped.
std::string to_csv(const Results& results);

/// Reads the measurements that `to_csv` wrote. A sweep's CSV does not hold its run, its reference
/// or its failures. Throws Error if the file holds anything else.
Results read_csv(const std::filesystem::path& file);

} // namespace argand
