#include "plot/plot.hpp"

#include "plot/measurements.hpp"

#include <algorithm>
#include <cmath>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <limits>
#include <regex>

namespace argand::testing {
namespace {

using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;

std::vector<std::string> texts(const Plot& plot) {
    std::vector<std::string> all;
    for (const PlotLabel& label : plot.labels) {
        all.push_back(label.text);
    }
    return all;
}

TEST(LogAxis, HoldsItsNumbersBetweenRoundEnds) {
    const LogAxis axis = log_axis({0.3, 4});
    EXPECT_EQ(axis.low, 0.2);
    EXPECT_EQ(axis.high, 5);
    EXPECT_THAT(axis.ticks, ElementsAre(0.2, 0.5, 1, 2, 5));
    EXPECT_THAT(log_axis({1e-4, 1e2}).ticks, ElementsAre(1e-4, 1e-3, 1e-2, 0.1, 1, 10, 100));
}

TEST(LogAxis, IsNotEmptyForOneNumberOrNone) {
    for (const std::vector<double>& values :
         {std::vector<double>{}, {1.0}, {2.0}, {1e-30}, {1e30}}) {
        const LogAxis axis = log_axis(values);
        EXPECT_LT(axis.low, axis.high);
        EXPECT_FALSE(axis.ticks.empty());
    }
}

TEST(Plot, FasterIsLeftAndMoreAccurateIsBelow) {
    const Plot plot = lay_out(results());
    EXPECT_LT(plot.points[0].place.x, plot.points[1].place.x);
    EXPECT_LT(plot.points[0].place.y, plot.points[1].place.y);
    EXPECT_EQ(plot.points[1].place.x, plot.points[2].place.x);
    EXPECT_TRUE(plot.points[0].on_front);
    EXPECT_TRUE(plot.points[1].on_front);
    EXPECT_FALSE(plot.points[2].on_front);
}

TEST(Plot, AllPointsLieInside) {
    const Plot plot = lay_out(results());
    for (const PlotPoint& point : plot.points) {
        EXPECT_TRUE(point.place.x > 0 && point.place.x < plot.width && point.place.y > 0 &&
                    point.place.y < plot.height);
    }
}

TEST(Plot, ErrorsBelowTheLeastOneLieOnTheLowerEdge) {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    Results some = results();
    some.reference_error = 1e-4;
    some.least_error = 1e-5;
    for (const double error : {0.0, -1e-3, 1e-320, 1e-6, infinity}) {
        some.measurements.push_back(measurement("path", 20, error));
    }
    const Plot plot = lay_out(some);
    ASSERT_EQ(plot.points.size(), 3 + 4 + 2u) << "all but what is infinite, and the legend's two";
    double edge = 0;
    for (const PlotLine& line : plot.lines) {
        if (line.kind == LineKind::grid) {
            edge = std::max(edge, std::max(line.from.y, line.to.y));
        }
    }
    for (std::size_t i = 3; i < 7; ++i) {
        EXPECT_NEAR(plot.points[i].place.y, edge, 1e-6);
        EXPECT_EQ(plot.points[i].on_front, i == 3) << "one of them, as they cannot be told apart";
        EXPECT_THAT(plot.points[i].title, HasSubstr("counts as 1e-05"));
    }
    EXPECT_FALSE(std::regex_search(to_svg(plot), std::regex("\\b(nan|inf)\\b")));
}

TEST(Plot, ALineIsDrawnAtTheReferencesOwnError) {
    Results some = results();
    EXPECT_THAT(texts(lay_out(some)), Not(Contains(HasSubstr("reference"))));
    // At the error of the second point.
    some.reference_error = 0.001;
    const Plot plot = lay_out(some);
    EXPECT_THAT(texts(plot), Contains("below: within the reference's noise"));
    EXPECT_TRUE(std::any_of(plot.lines.begin(), plot.lines.end(), [&](const PlotLine& line) {
        return line.kind == LineKind::noise && line.from.y == plot.points[1].place.y &&
               line.from.y == line.to.y && line.to.x - line.from.x > plot.width / 2;
    }));
}

TEST(Plot, AnExactReferenceHasNoNoise) {
    Results dark{.reference_error = 0,
                 .measurements = {measurement("path", 1, 0), measurement("photons", 2, 0)}};
    const Plot plot = lay_out(dark);
    EXPECT_EQ(plot.points.size(), 2 + 2u);
    EXPECT_TRUE(plot.points[0].on_front);
    EXPECT_THAT(texts(plot), Contains("on this line: no error found"));
    EXPECT_THAT(texts(plot), Not(Contains(HasSubstr("noise"))));
}

TEST(Plot, BarsSpanTheDeviation) {
    const auto has_bar = [](const Plot& plot, std::size_t point, double low, double high) {
        const double x = plot.points[point].place.x;
        return std::any_of(plot.lines.begin(), plot.lines.end(), [&](const PlotLine& line) {
            return line.kind == LineKind::bar && line.from.x == x && line.to.x == x &&
                   std::abs(line.from.y - low) < 1e-6 && std::abs(line.to.y - high) < 1e-6;
        });
    };
    Results some = results();
    some.measurements[2].rel_mse = {
        0.0505, 0.0495}; // from 0.001 to 0.1, the errors of the other two points
    const Plot plot = lay_out(some);
    EXPECT_TRUE(has_bar(plot, 2, plot.points[1].place.y, plot.points[0].place.y));
    EXPECT_FALSE(has_bar(lay_out(results()), 2, plot.points[1].place.y, plot.points[0].place.y))
        << "without deviation";
    // A bar that would reach below 0 ends at the axis. Nothing lies outside the frame.
    some.measurements[1].rel_mse.deviation = 10;
    for (const PlotLine& line : lay_out(some).lines) {
        EXPECT_TRUE(line.to.y > 0 && line.from.y < plot.height - 60)
            << line.from.y << " " << line.to.y;
    }
}

TEST(Plot, HasATitleAndSaysWhichDirectionIsBetter) {
    Results some = results();
    some.run["scene"] = "r\u00f6hre.glb";
    const Plot plot = lay_out(some);
    EXPECT_THAT(texts(plot), Contains("r\u00f6hre.glb: error against time"));
    EXPECT_THAT(texts(plot), Contains(HasSubstr("better is down")));
    some.run["scene"] = std::string(1000, 'x');
    for (const std::string& text : texts(lay_out(some))) {
        EXPECT_LT(text.size(), 80u);
    }
}

} // namespace
} // namespace argand::testing
