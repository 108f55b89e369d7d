#include "fake.hpp"
#include "image/srgb.hpp"
#include "tradeoff/plot.hpp"

#include <limits>
#include <regex>

namespace argand::testing {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

Measurement measurement(const std::string& method, double seconds, double error) {
    return {.method = method, .knob = "default", .options = "--method " + method, .wall_seconds = seconds,
            .rel_mse = {error, 0}, .ssim = {1, 0}};
}

Results results() {
    return {.measurements = {measurement("path", 1, 0.1), measurement("photons", 10, 0.001),
                             measurement("photons", 10, 0.05)}};
}

TEST(LogAxis, HoldsItsNumbersBetweenRoundEnds) {
    const LogAxis axis = log_axis({0.3, 4});
    EXPECT_EQ(axis.low, 0.2);
    EXPECT_EQ(axis.high, 5);
    EXPECT_THAT(axis.ticks, ElementsAre(0.2, 0.5, 1, 2, 5));
    EXPECT_THAT(log_axis({1e-4, 1e2}).ticks, ElementsAre(1e-4, 1e-3, 1e-2, 0.1, 1, 10, 100));
}

TEST(LogAxis, IsNotEmptyForOneNumberOrNone) {
    for (const std::vector<double>& values : {std::vector<double>{}, {1.0}, {2.0}, {1e-30}, {1e30}}) {
        const LogAxis axis = log_axis(values);
        EXPECT_LT(axis.low, axis.high);
        EXPECT_FALSE(axis.ticks.empty());
    }
}

TEST(Plot, QuickerLiesLeftAndMoreExactBelow) {
    const Plot plot = lay_out(results());
    EXPECT_LT(plot.points[0].place.x, plot.points[1].place.x);
    EXPECT_LT(plot.points[0].place.y, plot.points[1].place.y);
    EXPECT_EQ(plot.points[1].place.x, plot.points[2].place.x);
    EXPECT_TRUE(plot.points[0].on_front);
    EXPECT_TRUE(plot.points[1].on_front);
    EXPECT_FALSE(plot.points[2].on_front);
}

TEST(Plot, AllLiesWithinThePicture) {
    const Plot plot = lay_out(results());
    for (const PlotPoint& point : plot.points) {
        EXPECT_TRUE(point.place.x > 0 && point.place.x < plot.width && point.place.y > 0 && point.place.y < plot.height);
    }
}

TEST(Plot, LeavesOutWhatHasNoLogarithm) {
    Results some{.measurements = {measurement("path", 1, 0), measurement("path", 1, -1e-9), measurement("path", 1, 1e-320),
                                  measurement("path", 1, std::numeric_limits<double>::infinity())}};
    const Plot plot = lay_out(some);
    EXPECT_EQ(plot.points.size(), 1u) << "but for the legend's";
    EXPECT_FALSE(std::regex_search(to_svg(plot), std::regex("\\b(nan|inf)\\b")));
}

TEST(Plot, SvgSaysWhatAPointIsWhereItIsPointedAt) {
    Results some = results();
    some.measurements[0].options = "--a <&\">";
    const std::string svg = to_svg(lay_out(some));
    EXPECT_THAT(svg, HasSubstr("<title>path, default"));
    EXPECT_THAT(svg, HasSubstr("--a &lt;&amp;&quot;&gt;"));
}

TEST(Plot, ImageHasPointsOfTheirColourOnWhite) {
    const Plot plot = lay_out(results());
    const Image image = to_image(plot);
    const auto pixel = [&](double x, double y) {
        return image.pixels[static_cast<std::size_t>(static_cast<int>(y) * image.width + static_cast<int>(x))];
    };
    EXPECT_EQ(pixel(2, 2), glm::vec3(1));
    for (const PlotPoint& point : {plot.points[0], plot.points[1]}) {
        const glm::vec3 found = pixel(point.place.x, point.place.y);
        EXPECT_NEAR(srgb_encode(found.r) * 255, point.color >> 16, 1);
        EXPECT_NEAR(srgb_encode(found.b) * 255, point.color & 255, 1);
    }
}

} // namespace
} // namespace argand::testing
