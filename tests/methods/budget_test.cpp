#include "methods/budget.hpp"

#include <gtest/gtest.h>
#include <thread>

namespace argand {
namespace {

void spend(double seconds) { std::this_thread::sleep_for(std::chrono::duration<double>(seconds)); }

TEST(Budget, WhatIsDoneOnceIsNoPartOfAPass) {
    Budget budget(1.0);
    spend(0.3);
    budget.start_pass();
    spend(0.01);
    const int learnt = budget.once([] {
        spend(0.3);
        return 7;
    });
    EXPECT_EQ(learnt, 7);
    // 0.4 s remain.
    EXPECT_TRUE(budget.another(1, 1));
    EXPECT_GT(budget.expected(1, 1), 2);
}

TEST(Budget, EndsBeforeAPassThatDoesNotFit) {
    Budget budget(0.3);
    budget.start_pass();
    spend(0.2);
    EXPECT_FALSE(budget.another(1, 1));
    EXPECT_GT(budget.share(1, 0, 1), 0.6);
}

TEST(Budget, WithoutATimeEveryPassIsMadeOnce) {
    Budget budget(std::nullopt);
    EXPECT_TRUE(budget.another(2, 3));
    EXPECT_FALSE(budget.another(3, 3));
    EXPECT_EQ(budget.share(1, 0.5, 3), 0.5);
    EXPECT_EQ(budget.expected(2, 3), 3);
}

} // namespace
} // namespace argand
