#include "sweep/results.hpp"

#include "support/expect_error.hpp"
#include "support/scratch_directory.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <limits>

namespace argand {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

Measurement measurement(double seconds, double error) {
    return {.method = "path", .wall_seconds = seconds, .rel_mse = {error, 0}};
}

TEST(Results, TheMostAccurateIsOnTheFrontIfNoErrorIsMeasurable) {
    for (const double error : {0.0, -1e-4, 1e-9}) {
        const Results results{.least_error = 1e-5,
                              .measurements = {measurement(1, 0.1), measurement(2, error)}};
        EXPECT_THAT(front_of(results), ElementsAre(0, 1)) << error;
        EXPECT_EQ(clamped_error(results, results.measurements[1]), 1e-5);
    }
}

TEST(Results, OfUnrankableMeasurementsTheFastestIsOnTheFront) {
    const Results results{
        .least_error = 1e-5,
        .measurements = {measurement(3, -1e-3), measurement(2, 1e-6), measurement(1, 0.1)}};
    EXPECT_THAT(front_of(results), ElementsAre(2, 1));
}

TEST(Results, InfiniteErrorsAreNotOnTheFront) {
    const Results results{.measurements = {measurement(1, std::numeric_limits<double>::infinity()),
                                           measurement(2, std::numeric_limits<double>::quiet_NaN()),
                                           measurement(3, 1)}};
    EXPECT_THAT(front_of(results), ElementsAre(2));
}

TEST(Results, CsvDoesNotClampErrors) {
    const Results results{.least_error = 1e-5, .measurements = {measurement(2, -0.125)}};
    EXPECT_THAT(to_csv(results), HasSubstr(",-0.125,"));
}

TEST(Results, CsvIsReadBack) {
    const testing::ScratchDirectory scratch;
    Results results{.measurements = {measurement(2, 0.1), measurement(3, 0.01)}};
    results.measurements[0].option = "spp";
    results.measurements[0].value = "4";
    results.measurements[0].options = "--method path --spp 4";
    results.measurements[0].rel_mse.deviation = 0.001;
    results.measurements[0].bias = -1e-7;
    results.measurements[0].variance = 0.5;
    results.measurements[0].device_seconds = 1.5;
    results.measurements[1].rel_mse.mean = std::numeric_limits<double>::infinity();
    testing::write_text(scratch / "a.csv", to_csv(results));
    const Results read = read_csv(scratch / "a.csv");
    EXPECT_EQ(to_csv(read), to_csv(results));
    EXPECT_EQ(read.measurements.at(0).bias, -1e-7);
    EXPECT_EQ(read.measurements.at(1).rel_mse.mean, std::numeric_limits<double>::infinity());
    EXPECT_FALSE(read.measurements.at(1).device_seconds);
}

TEST(Results, OtherTablesAreRefused) {
    const testing::ScratchDirectory scratch;
    const std::string csv = to_csv({.measurements = {measurement(2, 0.1)}});
    const std::string head = csv.substr(0, csv.find('\n') + 1);
    for (const std::string& text : {std::string(), std::string("a,b\n1,2\n"), head, head + "path\n",
                                    head + "path,,,x,,0,1,1,1,1,,,1,1,\n", "x" + csv}) {
        testing::write_text(scratch / "a.csv", text);
        EXPECT_THAT(testing::error_of([&] { read_csv(scratch / "a.csv"); }),
                    HasSubstr("not a table that `argand tradeoff` writes"))
            << text;
    }
}

} // namespace
} // namespace argand
