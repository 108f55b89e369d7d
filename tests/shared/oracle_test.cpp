// Tests the reference itself: the double build against closed forms and the standard library.
#include "oracle.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <random>

namespace argand::truth {
namespace {

constexpr long double pi = 3.14159265358979323846264338327950288L;

TEST(Oracle, ElementaryFunctionsAreDouble) {
    std::mt19937_64 bits(1);
    std::uniform_real_distribution<double> uniform;
    for (int i = 0; i < 100'000; ++i) {
        const double u = uniform(bits);
        EXPECT_NEAR(elementary("sin_2pi", u), double(std::sin(2 * pi * u)), 5e-16);
        EXPECT_NEAR(elementary("cos_2pi", u), double(std::cos(2 * pi * u)), 5e-16);
        const double x = 100 * (u - 0.5);
        EXPECT_DOUBLE_EQ(elementary("pow", u, x), std::pow(u, x));
    }
}

} // namespace
} // namespace argand::truth
