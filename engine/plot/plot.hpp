#pragma once

#include "sweep/results.hpp"

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace argand {

/// A logarithmic axis.
struct LogAxis {
    double low = 0.1, high = 10;
    std::vector<double> ticks; ///< ascending, within
};

/// An axis that holds these numbers above 0, with round ends.
LogAxis log_axis(const std::vector<double>& values);

/// A place in a picture, in pixels from the top left.
struct Place {
    double x = 0, y = 0;
};

struct PlotPoint {
    Place place;
    std::uint32_t color = 0; ///< 0xRRGGBB, sRGB
    bool on_front = false;
    std::string title; ///< says what it is, on several lines
};

struct PlotLabel {
    Place place; ///< its left end, middle or right end, at mid-height
    enum class Align { left, middle, right } align = Align::left;
    std::string text;
    std::uint32_t color = 0;
};

struct PlotLine {
    Place from, to;
    std::uint32_t color = 0;
    double width = 1;
};

/// Error against time, both logarithmic, laid out; it is drawn as SVG or PNG from this.
struct Plot {
    int width = 960, height = 600;
    std::vector<PlotLine>
        lines; ///< grid, axes, noise, bars, front: in the order in which they are drawn
    std::vector<PlotPoint> points;
    std::vector<PlotLabel> labels;
};

/// A point at the time and the counted error of each measurement that has both, with a bar of ± the
/// deviation of one seed; those that count as `least_error` lie on the lower edge. A line at the
/// reference's own error. A front drawn in steps, as what lies above and to the right of a point is
/// worse.
Plot lay_out(const Results& results);

/// An <svg> element, without reference to anything outside.
std::string to_svg(const Plot& plot);

/// The same as a picture, linear RGB.
Image to_image(const Plot& plot);

} // namespace argand
