#include "sweep/results.hpp"

#include "base/error.hpp"
#include "base/read_file.hpp"
#include "sweep/pareto.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace argand {

using Json = nlohmann::ordered_json;

namespace {

std::string cell(double value) { return std::isfinite(value) ? fmt::format("{}", value) : ""; }
std::string cell(const std::optional<double>& value) { return value ? cell(*value) : ""; }

Results results_from(const Json& json) {
    Results results;
    results.run = json.at("run");
    const Json& reference = json.at("reference");
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
             {{"samples", results.reference_samples},
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
    fail("going on with '{}': it is not what `argand tradeoff` writes; remove it, or name another "
         "folder",
         file.string());
}

double counted_error(const Results& results, const Measurement& measurement) {
    const double error = measurement.rel_mse.mean;
    return std::isfinite(error) ? std::max(error, results.least_error)
                                : std::numeric_limits<double>::infinity();
}

std::vector<std::size_t> front_of(const Results& results) {
    std::vector<TimeAndError> points;
    for (const Measurement& m : results.measurements) {
        points.push_back({m.wall_seconds, counted_error(results, m)});
    }
    return pareto_front(points);
}

std::string to_csv(const Results& results) {
    const std::vector<std::size_t> front = front_of(results);
    std::string csv =
        "method,knob,value,wall_seconds,device_seconds,peak_bytes,relMSE,relMSE_deviation,SSIM,"
        "SSIM_deviation,squared_bias,variance,seeds,on_front,options\n";
    for (std::size_t i = 0; i < results.measurements.size(); ++i) {
        const Measurement& m = results.measurements[i];
        const bool on_front = std::find(front.begin(), front.end(), i) != front.end();
        csv += fmt::format("{},{},{},{},{},{},{},{},{},{},{},{},{},{},{}\n", m.method, m.knob,
                           m.value, cell(m.wall_seconds), cell(m.device_seconds), m.peak_bytes,
                           cell(m.rel_mse.mean), cell(m.rel_mse.deviation), cell(m.ssim.mean),
                           cell(m.ssim.deviation), cell(m.bias), cell(m.variance), m.seeds,
                           on_front ? 1 : 0, m.options);
    }
    return csv;
}

} // namespace argand
