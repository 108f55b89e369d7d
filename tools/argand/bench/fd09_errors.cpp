#include "base/median.hpp"
#include "bench.hpp"
#include "fd09.hpp"
#include "fd09_map.hpp"
#include "fd09_reference.hpp"

#include <cmath>
#include <fmt/format.h>

namespace argand {

namespace {

constexpr int runs = 3;
constexpr double ladder[] = {0.25, 0.5, 1, 2, 4}; // factors on the photons of the other methods

/// Time [s] and error of an image, and statistics of its map.
struct Point {
    double seconds = 0, error = 0;
    RenderStatistics statistics;
};

/// Repeated measurements of a point. Runs of several series can be interleaved, because point()
/// takes the median at the end.
struct Series {
    RenderSettings settings;
    std::vector<double> seconds, errors;
    RenderStatistics statistics;

    void add_run(Device& device, const Scene& scene, const References& references,
                 std::uint32_t seed) {
        settings.seed = seed;
        RenderResult result;
        seconds.push_back(
            seconds_of(device, [&] { result = render_all(device, scene, settings); }));
        errors.push_back(rel_mse(result, references, "indirect"));
        statistics = result.statistics;
    }

    Point point() const {
        double error = 0;
        for (const double e : errors) {
            error += e / double(errors.size());
        }
        return {median(seconds), error, statistics};
    }
};

/// Time at which the error has the given value, interpolated logarithmically between points in
/// order of increasing photons. If the error is never reached or always undercut, the time of the
/// nearest end, marked as a bound.
nlohmann::ordered_json time_at(const std::vector<Point>& points, double error) {
    for (std::size_t i = 1; i < points.size(); ++i) {
        const Point& a = points[i - 1];
        const Point& b = points[i];
        if (a.error >= error && b.error <= error && a.error > b.error && b.error > 0) {
            const double t = std::log(a.error / error) / std::log(a.error / b.error);
            return a.seconds * std::pow(b.seconds / a.seconds, t);
        }
    }
    return points.front().error < error ? fmt::format("< {:.3g}", points.front().seconds)
                                        : fmt::format("> {:.3g}", points.back().seconds);
}

std::vector<std::string> peers() {
    std::vector<std::string> found;
    for (const std::string& name : method_names()) {
        if (name != "footprints" && name != "path") {
            found.push_back(name);
        }
    }
    return found;
}

} // namespace

void measure_errors(Device& device, const Scene& scene, const RenderSettings& settings,
                    std::uint32_t reference_samples, PaperTable& estimators, PaperTable& kernels) {
    const References references = trace_references(device, scene, settings, reference_samples);
    Series footprints{.settings = settings};
    footprints.settings.method = "footprints";
    Series uniform = footprints;
    uniform.settings.footprints.uniform_kernel = true;
    std::vector<std::vector<Series>> others;
    for (const std::string& name : peers()) {
        others.emplace_back();
        for (const double factor : ladder) {
            Series series{.settings = settings};
            series.settings.method = name;
            series.settings.photons = static_cast<std::uint64_t>(factor * double(settings.photons));
            others.back().push_back(series);
        }
    }
    for (std::uint32_t seed = 0; seed < runs; ++seed) {
        footprints.add_run(device, scene, references, seed);
        uniform.add_run(device, scene, references, seed);
        for (std::vector<Series>& of_method : others) {
            for (Series& series : of_method) {
                series.add_run(device, scene, references, seed);
            }
        }
    }

    const Point ours = footprints.point();
    nlohmann::ordered_json row{{"scene", scene.name},
                               {"triangles", scene.triangles.size()},
                               {"emitted", settings.photons},
                               {"hits", ours.statistics.photons_stored},
                               {"s", ours.statistics.smoothing},
                               {"r_max", ours.statistics.footprint_scale
                                             ? ours.statistics.footprint_scale->radius_max
                                             : 0.0f},
                               {"footprints a point", ours.statistics.mean_footprints},
                               {"relMSE, indirect", ours.error},
                               {"footprints [s]", ours.seconds}};
    const std::vector<std::string> names = peers();
    for (std::size_t i = 0; i < names.size(); ++i) {
        std::vector<Point> points;
        for (const Series& series : others[i]) {
            points.push_back(series.point());
        }
        const Point& same_photons = points[std::size(ladder) / 2];
        row[names[i] + ", same photons: relMSE"] = same_photons.error;
        row[names[i] + ", same photons [s]"] = same_photons.seconds;
        row[names[i] + ", most photons: relMSE"] = points.back().error;
        const nlohmann::ordered_json equal = time_at(points, ours.error);
        row[names[i] + ", equal error [s]"] = equal;
        row[names[i] + " / footprints"] =
            equal.is_number() ? nlohmann::ordered_json(equal.get<double>() / ours.seconds)
            : points.front().error < ours.error
                ? nlohmann::ordered_json(
                      fmt::format("< {:.3g}", points.front().seconds / ours.seconds))
                : nlohmann::ordered_json(
                      fmt::format("> {:.3g}", points.back().seconds / ours.seconds));
    }
    estimators.rows.push_back(row);
    const Point flat = uniform.point();
    kernels.rows.push_back({{"scene", scene.name},
                            {"relMSE, uniform", flat.error},
                            {"relMSE, Epanechnikov", ours.error},
                            {"uniform [s]", flat.seconds},
                            {"Epanechnikov [s]", ours.seconds},
                            {"rate, Epanechnikov / uniform", flat.seconds / ours.seconds}});
}

} // namespace argand
