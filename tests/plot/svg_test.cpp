#include "plot/plot.hpp"

#include "plot/measurements.hpp"
#include "plot/xml.hpp"

#include <algorithm>
#include <cmath>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <limits>
#include <optional>
#include <regex>

namespace argand::testing {
namespace {

using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;
using ::testing::SizeIs;

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double infinity = std::numeric_limits<double>::infinity();

XmlElement parsed(const Results& some) { return XmlParser::parse(to_svg(lay_out(some))); }

std::vector<XmlElement> lines(const XmlElement& svg, const std::string& kind) {
    std::vector<XmlElement> found;
    for (const XmlElement& line : svg.all("line")) {
        if (line.attributes.at("class") == kind) {
            found.push_back(line);
        }
    }
    return found;
}

/// The circles of the measurements, without the legend's, whose title is the name of a method.
std::vector<XmlElement> points(const XmlElement& svg) {
    std::vector<XmlElement> found;
    for (const XmlElement& circle : svg.all("circle")) {
        if (circle.children.at(0).text.find("relMSE") != std::string::npos) {
            found.push_back(circle);
        }
    }
    return found;
}

/// Reads positions as a reader of the plot does: from the labels of one axis.
class AxisReader {
public:
    /// along: "x" or "y". Takes the labels below, or left of, the axes.
    AxisReader(const XmlElement& svg, const std::string& along) : along_(along) {
        const XmlElement axis = lines(svg, "axis").at(along == "x" ? 0 : 1);
        const std::string across = along == "x" ? "y" : "x";
        const double edge = axis.number(across + "1");
        for (const XmlElement& label : svg.all("text")) {
            const double off = (along == "x" ? 1 : -1) * (label.number(across) - edge);
            if (off > 0 && off < 30 && std::regex_match(label.text, std::regex("[-+.e0-9]+"))) {
                ticks_.emplace_back(label.number(along), std::stod(label.text));
            }
        }
    }

    std::size_t count() const { return ticks_.size(); }

    /// The value at the position of an element's attribute.
    double value(const XmlElement& element, const std::string& attribute) const {
        const auto [first, low] = ticks_.front();
        const auto [last, high] = ticks_.back();
        const double share = (element.number(attribute) - first) / (last - first);
        return low * std::pow(high / low, share);
    }

private:
    std::string along_;
    std::vector<std::pair<double, double>> ticks_; ///< position and value
};

TEST(Svg, PointsLieAtTheirTimeAndErrorOnTheAxes) {
    const XmlElement svg = parsed(results());
    const AxisReader x(svg, "x"), y(svg, "y");
    ASSERT_GE(x.count(), 2u);
    ASSERT_GE(y.count(), 2u);
    const std::vector<XmlElement> circles = points(svg);
    ASSERT_THAT(circles, SizeIs(3));
    const std::vector<Measurement> expected = results().measurements;
    for (std::size_t i = 0; i < 3; ++i) {
        EXPECT_NEAR(x.value(circles[i], "cx") / expected[i].wall_seconds, 1, 0.01);
        EXPECT_NEAR(y.value(circles[i], "cy") / expected[i].rel_mse.mean, 1, 0.01);
        EXPECT_THAT(circles[i].children.at(0).text, HasSubstr(expected[i].options));
        EXPECT_EQ(circles[i].attributes.contains("stroke"), i < 2) << "outlined on the front";
    }
    EXPECT_EQ(circles[1].attributes.at("fill"), circles[2].attributes.at("fill"));
    EXPECT_NE(circles[0].attributes.at("fill"), circles[1].attributes.at("fill"));
}

TEST(Svg, AxesMeetAtTheLowerLeftOfTheGrid) {
    const XmlElement svg = parsed(results());
    const std::vector<XmlElement> axes = lines(svg, "axis");
    ASSERT_THAT(axes, SizeIs(2));
    for (const char* end : {"x1", "y1"}) {
        EXPECT_EQ(axes[0].number(end), axes[1].number(end));
    }
    EXPECT_EQ(axes[0].number("y1"), axes[0].number("y2"));
    EXPECT_EQ(axes[1].number("x1"), axes[1].number("x2"));
    const std::vector<XmlElement> grid = lines(svg, "grid");
    EXPECT_EQ(grid.size(), AxisReader(svg, "x").count() + AxisReader(svg, "y").count());
    for (const XmlElement& line : grid) {
        EXPECT_GE(line.number("x1"), axes[0].number("x1"));
        EXPECT_LE(line.number("y1"), axes[0].number("y1"));
    }
    std::vector<std::string> texts;
    for (const XmlElement& label : svg.all("text")) {
        texts.push_back(label.text);
    }
    EXPECT_THAT(texts, Contains("seconds to render"));
    EXPECT_THAT(texts, Contains("error (relMSE)"));
}

TEST(Svg, FrontStepsFromPointToPoint) {
    const XmlElement svg = parsed(results());
    const std::vector<XmlElement> front = lines(svg, "front");
    const std::vector<XmlElement> circles = points(svg);
    ASSERT_THAT(front, SizeIs(2 + 1)) << "two lines of one step, and the legend's";
    const auto ends = [](const XmlElement& line) {
        return std::vector{line.number("x1"), line.number("y1"), line.number("x2"),
                           line.number("y2")};
    };
    const double x1 = circles[0].number("cx"), y1 = circles[0].number("cy");
    const double x2 = circles[1].number("cx"), y2 = circles[1].number("cy");
    EXPECT_THAT(ends(front[0]), ElementsAre(x1, y1, x2, y1));
    EXPECT_THAT(ends(front[1]), ElementsAre(x2, y1, x2, y2));
}

TEST(Svg, EscapesText) {
    Results some = results();
    some.run["scene"] = "a<b>&\"c\".glb";
    some.measurements[0].options = "--a <&\"> \x01";
    const XmlElement svg = parsed(some);
    EXPECT_THAT(points(svg).at(0).children.at(0).text, HasSubstr("\n--a <&\"> ?"));
    std::vector<std::string> texts;
    for (const XmlElement& label : svg.all("text")) {
        texts.push_back(label.text);
    }
    EXPECT_THAT(texts, Contains("a<b>&\"c\".glb: error against time"));
}

TEST(Svg, WithoutMeasurementsHasAxesAlone) {
    const XmlElement svg = parsed({});
    EXPECT_THAT(points(svg), IsEmpty());
    EXPECT_THAT(lines(svg, "axis"), SizeIs(2));
    EXPECT_THAT(lines(svg, "front"), SizeIs(1)) << "of the legend";
    EXPECT_GE(AxisReader(svg, "x").count(), 2u);
}

TEST(Svg, LeavesOutWhatIsNotFinite) {
    Results some = results();
    for (const double odd : {nan, infinity, -infinity}) {
        some.measurements.push_back(measurement("path", 2, odd));
        some.measurements.push_back(measurement("path", odd, 0.01));
        some.measurements.push_back(measurement("path", 3, 0.2)); // off the front
        some.measurements.back().rel_mse.deviation = odd;
    }
    some.measurements.push_back(measurement("path", 0, 0.01));
    some.reference_error = nan;
    const std::string text = to_svg(lay_out(some));
    const XmlElement svg = XmlParser::parse(text);
    EXPECT_THAT(points(svg), SizeIs(3 + 3)) << "those whose deviation alone is not finite";
    EXPECT_THAT(lines(svg, "bar"), IsEmpty());
    const std::regex odd_number("=\"-?(nan|inf)");
    EXPECT_FALSE(std::regex_search(text, odd_number));
    some.reference_error = infinity;
    EXPECT_FALSE(std::regex_search(to_svg(lay_out(some)), odd_number));
}

TEST(Svg, BarsAndNoiseAreLines) {
    Results some = results();
    some.measurements[2].rel_mse.deviation = 0.01;
    some.reference_error = 0.002;
    const XmlElement svg = parsed(some);
    const AxisReader y(svg, "y");
    const std::vector<XmlElement> bar = lines(svg, "bar");
    ASSERT_THAT(bar, SizeIs(3)) << "with two caps";
    EXPECT_NEAR(y.value(bar[0], "y1") / 0.04, 1, 0.01);
    EXPECT_NEAR(y.value(bar[0], "y2") / 0.06, 1, 0.01);
    const std::vector<XmlElement> noise = lines(svg, "noise");
    ASSERT_THAT(noise, SizeIs(1));
    EXPECT_NEAR(y.value(noise[0], "y1") / 0.002, 1, 0.01);
}

TEST(Svg, FileHasNamespaceSizeAndBackground) {
    const XmlElement svg = XmlParser::parse(to_svg_file(lay_out(results())));
    EXPECT_EQ(svg.name, "svg");
    EXPECT_EQ(svg.attributes.at("xmlns"), "http://www.w3.org/2000/svg");
    EXPECT_EQ(svg.attributes.at("viewBox"), "0 0 960 600");
    EXPECT_EQ(svg.number("width"), 960);
    EXPECT_EQ(svg.number("height"), 600);
    ASSERT_FALSE(svg.children.empty());
    EXPECT_EQ(svg.children[0].name, "rect");
    EXPECT_EQ(svg.children[0].attributes.at("fill"), "#ffffff");
    // Inside a page the element refers to nothing outside.
    EXPECT_THAT(to_svg(lay_out(results())), Not(HasSubstr("http")));
}

TEST(Svg, ParserRejectsMalformedText) {
    for (const char* text : {"", "<a>", "<a></b>", "<a b=c/>", "<a b=\"1\" b=\"2\"/>", "<a>&x;</a>",
                             "<a/><b/>", "<a b=\"<\"/>", "<a>\x02</a>"}) {
        EXPECT_THROW(XmlParser::parse(text), std::runtime_error) << text;
    }
    EXPECT_EQ(XmlParser::parse("<a b=\"&quot;\"> x <c/> y </a>").text, " x  y ");
}

} // namespace
} // namespace argand::testing
