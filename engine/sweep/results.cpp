#include "sweep/results.hpp"

#include "base/error.hpp"
#include "base/read_file.hpp"
#include "sweep/pareto.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/ranges.h>
#include <limits>
#include <sstream>
#include <stdexcept>
#include <string_view>

namespace argand {

using Json = nlohmann::ordered_json;

namespace {

constexpr std::string_view csv_header =
    "method,knob,value,wall_seconds,device_seconds,peak_bytes,relMSE,relMSE_deviation,SSIM,"
    "SSIM_deviation,squared_bias,variance,seeds,on_front,options";

std::string cell(double value) { return std::isfinite(value) ? fmt::format("{}", value) : ""; }
std::string cell(const std::optional<double>& value) { return value ? cell(*value) : ""; }

std::vector<std::string> cells_of(const std::string& line) {
    std::vector<std::string> cells(1);
    for (const char c : line) {
        if (c == ',') {
            cells.emplace_back();
        } else {
            cells.back() += c;
        }
    }
    return cells;
}

std::optional<double> number_or_none(const std::string& cell) {
    return cell.empty() ? std::nullopt : std::optional(std::stod(cell));
}

double number_or_infinity(const std::string& cell) {
    return number_or_none(cell).value_or(std::numeric_limits<double>::infinity());
}

/// The measurement in the cells of a line. Throws std::logic_error if it is none.
Measurement measurement_in(const std::vector<std::string>& cells) {
    return {.key = "",
            .method = cells.at(0),
            .option = cells.at(1),
            .value = cells.at(2),
            .options = cells.at(14),
            .picture = "",
            .seeds = std::stoull(cells.at(12)),
            .wall_seconds = number_or_infinity(cells.at(3)),
            .device_seconds = number_or_none(cells.at(4)),
            .peak_bytes = std::stoull(cells.at(5)),
            .rel_mse = {number_or_infinity(cells.at(6)), number_or_infinity(cells.at(7))},
            .ssim = {number_or_infinity(cells.at(8)), number_or_infinity(cells.at(9))},
            .bias = number_or_none(cells.at(10)),
            .variance = number_or_none(cells.at(11))};
}

Results results_from(const Json& json) {
    Results results;
    results.run = json.at("run");
    const Json& reference = json.at("reference");
    results.reference_method = reference.value("method", "path");
    results.reference_is_blind = reference.value("misses_caustics", false);
    results.reference_samples = reference.at("samples");
    if (!reference.at("own_error").is_null()) {
        results.reference_error = reference.at("own_error").get<double>();
    }
    results.least_error = reference.at("least_error");
    for (const auto& [method, widths] : json.at("learnt").items()) {
        RenderStatistics& statistics = results.learnt[method];
        statistics.radius = widths.at("radius");
        statistics.neighbours = widths.at("k");
        statistics.smoothing = widths.at("smoothing");
    }
    for (const Json& failure : json.at("failures")) {
        results.failures.push_back({failure.at("options"), failure.at("why")});
    }
    results.complete = json.at("complete");
    for (const Json& measurement : json.at("measurements")) {
        results.measurements.push_back(measurement_from(measurement));
    }
    return results;
}

} // namespace

Json to_json(const Results& results) {
    Json learnt = Json::object();
    for (const auto& [method, widths] : results.learnt) {
        learnt[method] = {
            {"radius", widths.radius}, {"k", widths.neighbours}, {"smoothing", widths.smoothing}};
    }
    Json measurements = Json::array();
    for (const Measurement& measurement : results.measurements) {
        measurements.push_back(to_json(measurement));
    }
    Json failures = Json::array();
    for (const Failure& failure : results.failures) {
        failures.push_back({{"options", failure.options}, {"why", failure.why}});
    }
    return {{"run", results.run},
            {"reference",
             {{"method", results.reference_method},
              {"misses_caustics", results.reference_is_blind},
              {"samples", results.reference_samples},
              {"own_error", results.reference_error ? Json(*results.reference_error) : Json()},
              {"least_error", results.least_error}}},
            {"learnt", learnt},
            {"failures", failures},
            {"complete", results.complete},
            {"measurements", measurements}};
}

Results read_results(const std::filesystem::path& file) try {
    const std::vector<std::uint8_t> bytes = read_file(file);
    return results_from(Json::parse(bytes.begin(), bytes.end()));
} catch (const nlohmann::json::exception&) {
    fail("reading '{}': it is not a file that `argand tradeoff` writes; remove it, or choose "
         "another folder",
         file.string());
}

double clamped_error(const Results& results, const Measurement& measurement) {
    const double error = measurement.rel_mse.mean;
    return std::isfinite(error) ? std::max(error, results.least_error)
                                : std::numeric_limits<double>::infinity();
}

std::vector<std::size_t> front_of(const Results& results) {
    std::vector<TimeAndError> points;
    for (const Measurement& m : results.measurements) {
        points.push_back({m.wall_seconds, clamped_error(results, m)});
    }
    return pareto_front(points);
}

std::string to_csv(const Results& results) {
    const std::vector<std::size_t> front = front_of(results);
    std::string csv = std::string(csv_header) + "\n";
    for (std::size_t i = 0; i < results.measurements.size(); ++i) {
        const Measurement& m = results.measurements[i];
        const bool on_front = std::find(front.begin(), front.end(), i) != front.end();
        const std::string cells[] = {m.method,
                                     m.option,
                                     m.value,
                                     cell(m.wall_seconds),
                                     cell(m.device_seconds),
                                     fmt::format("{}", m.peak_bytes),
                                     cell(m.rel_mse.mean),
                                     cell(m.rel_mse.deviation),
                                     cell(m.ssim.mean),
                                     cell(m.ssim.deviation),
                                     cell(m.bias),
                                     cell(m.variance),
                                     fmt::format("{}", m.seeds),
                                     on_front ? "1" : "0",
                                     m.options};
        csv += fmt::format("{}\n", fmt::join(cells, ","));
    }
    return csv;
}

Results read_csv(const std::filesystem::path& file) {
    const std::vector<std::uint8_t> bytes = read_file(file);
    std::istringstream lines(std::string(bytes.begin(), bytes.end()));
    std::string line;
    std::getline(lines, line);
    const bool is_known = line == csv_header;
    Results results{.complete = true};
    try {
        while (is_known && std::getline(lines, line)) {
            results.measurements.push_back(measurement_in(cells_of(line)));
        }
    } catch (const std::logic_error&) { // of std::stod, std::stoull
        results.measurements.clear();
    }
    if (results.measurements.empty()) {
        fail("reading '{}': it is not a table that `argand tradeoff` writes", file.string());
    }
    return results;
}

} // namespace argand
