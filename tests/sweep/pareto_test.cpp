#include "sweep/pareto.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <limits>

namespace argand {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

std::vector<std::size_t> front(const std::vector<TimeAndError>& points) {
    return pareto_front(points);
}

TEST(Pareto, HoldsTheNonDominatedPoints) {
    EXPECT_THAT(front({{3, 1}, {1, 4}, {2, 5}, {2, 2}, {4, 1.5}, {5, 0.5}}),
                ElementsAre(1, 3, 0, 5));
}

TEST(Pareto, KeepsTheFirstOfEqualPoints) {
    EXPECT_THAT(front({{1, 1}, {1, 1}}), ElementsAre(0));
    EXPECT_THAT(front({{1, 2}, {1, 1}, {2, 1}}), ElementsAre(1));
}

TEST(Pareto, OmitsPointsThatAreNotFinite) {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    EXPECT_THAT(front({{1, infinity}, {2, std::numeric_limits<double>::quiet_NaN()}, {3, 1}}),
                ElementsAre(2));
    EXPECT_THAT(front({}), IsEmpty());
}

} // namespace
} // namespace argand
