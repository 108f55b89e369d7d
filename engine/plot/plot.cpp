#include "plot/plot.hpp"

#include "base/text.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <utility>

namespace argand {

namespace {

constexpr double left = 90, right = 170, top = 70, bottom = 70; // margins
constexpr std::uint32_t black = 0x222222, gray = 0x666666, grid = 0xdddddd, front_color = 0x666666,
                        noise_color = 0xc04000;

/// Colours that colour-blind readers can tell apart (Okabe and Ito 2008, "Color Universal Design").
constexpr std::array<std::uint32_t, 8> palette{0x0072b2, 0xe69f00, 0x009e73, 0xcc79a7,
                                               0xd55e00, 0x56b4e9, 0xf0e442, 0x000000};

/// The methods of the table, which keep their colours, then any others of the results.
std::vector<std::string> methods_of(const Results& results, MethodTable table) {
    std::vector<std::string> methods = table.names();
    for (const Measurement& m : results.measurements) {
        if (std::find(methods.begin(), methods.end(), m.method) == methods.end()) {
            methods.push_back(m.method);
        }
    }
    return methods;
}

std::uint32_t color_of(const std::vector<std::string>& methods, const std::string& method) {
    const auto place = std::find(methods.begin(), methods.end(), method) - methods.begin();
    return palette[static_cast<std::size_t>(place) % palette.size()];
}

/// Maps times and errors to positions.
struct Frame {
    LogAxis x, y;
    double width, height;

    Place at(double seconds, double error) const {
        const auto share = [](const LogAxis& axis, double value) {
            return std::log(value / axis.low) / std::log(axis.high / axis.low); // low < high
        };
        return {left + share(x, seconds) * (width - left - right),
                height - bottom - share(y, error) * (height - top - bottom)};
    }
};

/// Whether the measurement has a position in the plot.
bool can_be_drawn(const Measurement& m) {
    constexpr double least_seconds = 1e-30;
    return std::isfinite(m.rel_mse.mean) && std::isfinite(m.wall_seconds) &&
           m.wall_seconds > least_seconds;
}

bool is_clamped(const Results& results, const Measurement& m) {
    return m.rel_mse.mean < results.least_error;
}

bool any_clamped(const Results& results) {
    return std::any_of(
        results.measurements.begin(), results.measurements.end(),
        [&](const Measurement& m) { return can_be_drawn(m) && is_clamped(results, m); });
}

/// The error below which measurements are uncertain: the reference's own error, or the least error
/// that can be measured. Nothing if the former is unknown and no measurement is below the latter.
std::optional<double> noise_level(const Results& results) {
    if (results.reference_error && std::isfinite(*results.reference_error) &&
        *results.reference_error > results.least_error) {
        return results.reference_error;
    }
    return any_clamped(results) ? std::optional(results.least_error) : std::nullopt;
}

std::string title_of(const Results& results, const Measurement& m) {
    std::string title = m.option == "default"
                            ? m.method + ", default"
                            : fmt::format("{}, {} {}", m.method, m.option, m.value);
    title += fmt::format("\n{:.3g} s, relMSE {:.3g} ± {:.1g}", m.wall_seconds, m.rel_mse.mean,
                         m.rel_mse.deviation);
    if (m.bias) {
        title += fmt::format("\nsquared bias {:.2g}, variance {:.2g}", *m.bias, *m.variance);
    }
    if (is_clamped(results, m)) {
        title +=
            "\nno measurable error: it counts as " + fmt::format("{:.2g}", results.least_error);
    } else if (results.reference_error && m.rel_mse.mean < *results.reference_error) {
        title += "\nbelow the reference's own error: uncertain";
    }
    return title + "\n" + m.options;
}

void add_label(Plot& plot, Place place, PlotLabel::Align align, std::string text,
               std::uint32_t color) {
    PlotLabel label;
    label.place = place;
    label.align = align;
    label.text = std::move(text);
    label.color = color;
    plot.labels.push_back(std::move(label));
}

void add_axes(Plot& plot, const Frame& frame) {
    using Align = PlotLabel::Align;
    for (const double tick : frame.x.ticks) {
        const Place low = frame.at(tick, frame.y.low);
        plot.lines.push_back({LineKind::grid, low, frame.at(tick, frame.y.high), grid, 1});
        add_label(plot, {low.x, low.y + 18}, Align::middle, fmt::format("{:g}", tick), black);
    }
    for (const double tick : frame.y.ticks) {
        const Place low = frame.at(frame.x.low, tick);
        plot.lines.push_back({LineKind::grid, low, frame.at(frame.x.high, tick), grid, 1});
        add_label(plot, {low.x - 8, low.y}, Align::right, fmt::format("{:g}", tick), black);
    }
    const Place origin = frame.at(frame.x.low, frame.y.low);
    const Place end = frame.at(frame.x.high, frame.y.high);
    plot.lines.push_back({LineKind::axis, origin, {end.x, origin.y}, black, 1.5});
    plot.lines.push_back({LineKind::axis, origin, {origin.x, end.y}, black, 1.5});
    add_label(plot, {0.5 * (origin.x + end.x), origin.y + 44}, Align::middle, "seconds to render",
              black);
    add_label(plot, {16, end.y - 26}, Align::left, "error (relMSE)", black);
}

/// The scene, and which direction is better.
void add_title(Plot& plot, const Results& results) {
    constexpr std::size_t longest_name = 40; // bytes that fit above the plot
    std::string title = "Error against time";
    if (results.run.contains("scene")) {
        title = one_line(results.run.at("scene").get<std::string>(), longest_name) +
                ": error against time";
    }
    const double middle = 0.5 * (left + plot.width - right);
    add_label(plot, {middle, 18}, PlotLabel::Align::middle, title, black);
    add_label(plot, {middle, 42}, PlotLabel::Align::middle,
              "better is down (more accurate) and to the left (faster)", gray);
}

void add_noise(Plot& plot, const Results& results, const Frame& frame) {
    if (const std::optional<double> level = noise_level(results)) {
        const Place from = frame.at(frame.x.low, *level);
        plot.lines.push_back(
            {LineKind::noise, from, frame.at(frame.x.high, *level), noise_color, 1.5});
        // No points hide a label in the lower left, which only an ideal setting would reach.
        const bool is_noise = *level > results.least_error;
        add_label(plot, {from.x + 8, from.y + (is_noise ? 12 : -12)}, PlotLabel::Align::left,
                  is_noise ? "below: within the reference's noise" : "on this line: no error found",
                  noise_color);
    }
}

void add_bars(Plot& plot, const Results& results, const Frame& frame,
              const std::vector<std::string>& methods) {
    constexpr double cap = 3;
    for (const Measurement& m : results.measurements) {
        const double deviation = m.rel_mse.deviation;
        if (!can_be_drawn(m) || !(deviation > 0 && std::isfinite(deviation))) {
            continue;
        }
        const double error = clamped_error(results, m);
        const Place high = frame.at(m.wall_seconds, error + deviation);
        const Place low = frame.at(m.wall_seconds, std::max(error - deviation, frame.y.low));
        const std::uint32_t color = color_of(methods, m.method);
        plot.lines.push_back({LineKind::bar, low, high, color, 1});
        for (const Place& end : {low, high}) {
            plot.lines.push_back(
                {LineKind::bar, {end.x - cap, end.y}, {end.x + cap, end.y}, color, 1});
        }
    }
}

void add_legend(Plot& plot, const Results& results, const std::vector<std::string>& methods) {
    double y = top + 10;
    const double x = plot.width - right + 24;
    for (const std::string& method : methods) {
        if (std::any_of(results.measurements.begin(), results.measurements.end(),
                        [&](const Measurement& m) { return m.method == method; })) {
            plot.points.push_back({{x, y}, color_of(methods, method), true, method});
            add_label(plot, {x + 14, y}, PlotLabel::Align::left, method, black);
            y += 24;
        }
    }
    plot.lines.push_back({LineKind::front, {x - 8, y}, {x + 8, y}, front_color, 2});
    add_label(plot, {x + 14, y}, PlotLabel::Align::left, "Pareto front", black);
}

void add_front(Plot& plot, const Results& results, const Frame& frame,
               const std::vector<std::size_t>& front) {
    std::vector<Place> places;
    for (const std::size_t i : front) {
        const Measurement& m = results.measurements[i];
        if (can_be_drawn(m)) {
            places.push_back(frame.at(m.wall_seconds, clamped_error(results, m)));
        }
    }
    for (std::size_t i = 1; i < places.size(); ++i) {
        const Place corner{places[i].x, places[i - 1].y};
        plot.lines.push_back({LineKind::front, places[i - 1], corner, front_color, 2});
        plot.lines.push_back({LineKind::front, corner, places[i], front_color, 2});
    }
}

void add_points(Plot& plot, const Results& results, const Frame& frame,
                const std::vector<std::size_t>& front, const std::vector<std::string>& methods) {
    for (std::size_t i = 0; i < results.measurements.size(); ++i) {
        const Measurement& m = results.measurements[i];
        if (can_be_drawn(m)) {
            plot.points.push_back(
                {frame.at(m.wall_seconds, clamped_error(results, m)), color_of(methods, m.method),
                 std::find(front.begin(), front.end(), i) != front.end(), title_of(results, m)});
        }
    }
}

/// The part of the axis from `low` on.
LogAxis truncated_below(LogAxis axis, double low) {
    axis.low = low;
    std::erase_if(axis.ticks, [&](double tick) { return tick < low; });
    return axis;
}

/// Axes that hold all measurements, their bars and the reference's own error.
Frame frame_of(const Plot& plot, const Results& results) {
    std::vector<double> times, errors;
    for (const Measurement& m : results.measurements) {
        if (can_be_drawn(m)) {
            times.push_back(m.wall_seconds);
            errors.push_back(clamped_error(results, m));
            if (std::isfinite(m.rel_mse.deviation)) {
                errors.push_back(errors.back() + m.rel_mse.deviation);
            }
        }
    }
    if (const std::optional<double> level = noise_level(results); level && !errors.empty()) {
        errors.push_back(*level);
    }
    LogAxis y = log_axis(errors);
    if (any_clamped(results)) {
        y = truncated_below(y, results.least_error);
    }
    return {log_axis(times), y, static_cast<double>(plot.width), static_cast<double>(plot.height)};
}

} // namespace

LogAxis log_axis(const std::vector<double>& values) {
    LogAxis axis;
    if (!values.empty()) {
        const auto [least, most] = std::minmax_element(values.begin(), values.end());
        axis.low = *least;
        axis.high = *most;
    }
    const int first = static_cast<int>(std::floor(std::log10(axis.low)));
    const int last = static_cast<int>(std::ceil(std::log10(axis.high)));
    std::vector<double> round;
    for (int decade = first - 1; decade <= last; ++decade) {
        for (const int step : {1, 2, 5}) {
            round.push_back(std::stod(fmt::format("{}e{}", step, decade)));
        }
    }
    // Takes a round number beyond each end, so that no point lies on the frame.
    axis.low = *std::prev(std::lower_bound(round.begin(), round.end(), axis.low));
    axis.high = *std::upper_bound(round.begin(), round.end() - 1, axis.high);
    for (const double tick : round) {
        const bool decade = fmt::format("{:e}", tick).front() == '1';
        if (tick >= axis.low && tick <= axis.high && (decade || last - first <= 3)) {
            axis.ticks.push_back(tick);
        }
    }
    return axis;
}

Plot lay_out(const Results& results, MethodTable table) {
    Plot plot;
    const std::vector<std::string> methods = methods_of(results, table);
    const Frame frame = frame_of(plot, results);
    add_axes(plot, frame);
    add_title(plot, results);
    add_noise(plot, results, frame);
    add_bars(plot, results, frame, methods);
    const std::vector<std::size_t> front = front_of(results);
    add_front(plot, results, frame, front);
    add_points(plot, results, frame, front, methods);
    add_legend(plot, results, methods);
    return plot;
}

} // namespace argand
