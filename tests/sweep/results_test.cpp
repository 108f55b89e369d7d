#include "sweep/results.hpp"

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

TEST(Results, TheMostExactIsOnTheFrontWhereNoErrorIsLeft) {
    for (const double error : {0.0, -1e-4, 1e-9}) {
        const Results results{.least_error = 1e-5,
                              .measurements = {measurement(1, 0.1), measurement(2, error)}};
        EXPECT_THAT(front_of(results), ElementsAre(0, 1)) << error;
        EXPECT_EQ(counted_error(results, results.measurements[1]), 1e-5);
    }
}

TEST(Results, WhatCannotBeToldApartIsNotWorthMoreTime) {
    const Results results{
        .least_error = 1e-5,
        .measurements = {measurement(3, -1e-3), measurement(2, 1e-6), measurement(1, 0.1)}};
    EXPECT_THAT(front_of(results), ElementsAre(2, 1));
}

TEST(Results, WhatIsNotFiniteIsNotOnTheFront) {
    const Results results{.measurements = {measurement(1, std::numeric_limits<double>::infinity()),
                                           measurement(2, std::numeric_limits<double>::quiet_NaN()),
                                           measurement(3, 1)}};
    EXPECT_THAT(front_of(results), ElementsAre(2));
}

TEST(Results, CsvKeepsTheErrorAsItWasMeasured) {
    const Results results{.least_error = 1e-5, .measurements = {measurement(2, -0.125)}};
    EXPECT_THAT(to_csv(results), HasSubstr(",-0.125,"));
}

} // namespace
} // namespace argand
