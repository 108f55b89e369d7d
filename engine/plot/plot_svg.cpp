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

} // namespace

std::string to_svg(const Plot& plot) {
    std::string svg =
        fmt::format("<svg viewBox=\"0 0 {} {}\" font-family=\"sans-serif\" font-size=\"14\">\n",
                    plot.width, plot.height);
    for (const PlotLine& line : plot.lines) {
        svg += fmt::format(
            "<line x1=\"{:.1f}\" y1=\"{:.1f}\" x2=\"{:.1f}\" y2=\"{:.1f}\" stroke=\"#{:06x}\" "
            "stroke-width=\"{}\"/>\n",
            line.from.x, line.from.y, line.to.x, line.to.y, line.color, line.width);
    }
    for (const PlotPoint& point : plot.points) {
        svg += fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"{}\" "
                           "fill=\"#{:06x}\"{}><title>{}</title></circle>\n",
                           point.place.x, point.place.y, point.on_front ? 6 : 4, point.color,
                           point.on_front ? " stroke=\"#222222\" stroke-width=\"1.5\""
                                          : " fill-opacity=\"0.6\"",
                           escaped(point.title));
    }
    for (const PlotLabel& label : plot.labels) {
        svg += fmt::format(
            "<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"{}\" dominant-baseline=\"central\" "
            "fill=\"#{:06x}\">{}</text>\n",
            label.place.x, label.place.y, anchor(label.align), label.color, escaped(label.text));
    }
    return svg + "</svg>\n";
}

} // namespace argand
