#pragma once

#include "methods/table.hpp"
#include "sweep/results.hpp"

#include <cstdint>
#include <string>
#include <vector>

namespace argand {

/// A logarithmic axis.
struct LogAxis {
    double low = 0.1, high = 10;
    std::vector<double> ticks; ///< ascending, within [low, high]
};

/// An axis with round ends that holds these values, all above 0.
LogAxis log_axis(const std::vector<double>& values);

/// A position in the plot, in pixels from the top left.
struct Place {
    double x = 0, y = 0;
};

/// A measured setting, or an entry of the legend.
struct PlotPoint {
    Place place;
    std::uint32_t color = 0; ///< 0xRRGGBB, sRGB
    bool on_front = false;
    std::string title; ///< tooltip, on several lines
};

struct PlotLabel {
    Place place; ///< left end, middle or right end of the text, at mid-height
    enum class Align { left, middle, right } align = Align::left;
    std::string text;
    std::uint32_t color = 0;
};

/// The parts of a plot that are made of lines.
enum class LineKind { grid, axis, noise, bar, front };

struct PlotLine {
    LineKind kind = LineKind::grid;
    Place from, to;
    std::uint32_t color = 0;
    double width = 1; ///< in pixels
};

/// The layout of a plot of error against time, with logarithmic axes.
struct Plot {
    int width = 960, height = 600;
    std::vector<PlotLine> lines;   ///< in drawing order
    std::vector<PlotPoint> points; ///< the measurements, then the legend; drawn above the lines
    std::vector<PlotLabel> labels; ///< drawn last
};

/// Lays out a point at the time and the clamped error of each measurement for which both are
/// finite, with a bar of ± one standard deviation of a single seed. Clamped measurements lie on the
/// lower edge. A line marks the reference's own error. The Pareto front is drawn in steps, because
/// everything above and to the right of one of its points is worse. Methods of the table keep their
/// colours, whichever of them were measured.
Plot lay_out(const Results& results, MethodTable table = builtin_methods());

/// The plot as an <svg> element for use inside an HTML page. Refers to nothing outside.
std::string to_svg(const Plot& plot);

/// The plot as the contents of an SVG file, on a white background.
std::string to_svg_file(const Plot& plot);

} // namespace argand
