#include "plot/markup.hpp"
#include "plot/plot.hpp"

#include <fmt/format.h>

namespace argand {

namespace {

const char* anchor(PlotLabel::Align align) {
    switch (align) {
    case PlotLabel::Align::middle:
        return "middle";
    case PlotLabel::Align::right:
        return "end";
    default:
        return "start";
    }
}

const char* class_of(LineKind kind) {
    switch (kind) {
    case LineKind::axis:
        return "axis";
    case LineKind::noise:
        return "noise";
    case LineKind::bar:
        return "bar";
    case LineKind::front:
        return "front";
    default:
        return "grid";
    }
}

std::string line_svg(const PlotLine& line) {
    const std::string ends = fmt::format(R"(x1="{:.1f}" y1="{:.1f}" x2="{:.1f}" y2="{:.1f}")",
                                         line.from.x, line.from.y, line.to.x, line.to.y);
    return fmt::format("<line class=\"{}\" {} stroke=\"#{:06x}\" stroke-width=\"{}\"/>\n",
                       class_of(line.kind), ends, line.color, line.width);
}

std::string point_svg(const PlotPoint& point) {
    const char* look = point.on_front ? R"(r="6" stroke="#222222" stroke-width="1.5")"
                                      : R"(r="4" fill-opacity="0.6")";
    return fmt::format(
        "<circle cx=\"{:.1f}\" cy=\"{:.1f}\" {} fill=\"#{:06x}\"><title>{}</title></circle>\n",
        point.place.x, point.place.y, look, point.color, escaped(point.title));
}

std::string label_svg(const PlotLabel& label) {
    // Not every viewer supports dominant-baseline: dy moves the text to mid-height instead.
    return fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" dy=\"0.35em\" text-anchor=\"{}\" "
                       "fill=\"#{:06x}\">{}</text>\n",
                       label.place.x, label.place.y, anchor(label.align), label.color,
                       escaped(label.text));
}

/// The element with further attributes, and with further contents before the plot.
std::string svg_element(const Plot& plot, const std::string& attributes,
                        const std::string& background) {
    std::string svg =
        fmt::format("<svg viewBox=\"0 0 {} {}\" font-family=\"sans-serif\" font-size=\"14\"{}>\n{}",
                    plot.width, plot.height, attributes, background);
    for (const PlotLine& line : plot.lines) {
        svg += line_svg(line);
    }
    for (const PlotPoint& point : plot.points) {
        svg += point_svg(point);
    }
    for (const PlotLabel& label : plot.labels) {
        svg += label_svg(label);
    }
    return svg + "</svg>\n";
}

} // namespace

std::string to_svg(const Plot& plot) { return svg_element(plot, "", ""); }

std::string to_svg_file(const Plot& plot) {
    return svg_element(plot,
                       fmt::format(R"( xmlns="http://www.w3.org/2000/svg" width="{}" height="{}")",
                                   plot.width, plot.height),
                       "<rect width=\"100%\" height=\"100%\" fill=\"#ffffff\"/>\n");
}

} // namespace argand
