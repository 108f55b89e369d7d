#include "base/interrupt.hpp"
#include <csignal>
#include <gtest/gtest.h>

using namespace argand;

namespace {

/// What the test's own parent made of the signals (a background job ignores SIGINT) must not
/// matter.
void take_signals_as_usual() {
    std::signal(SIGINT, SIG_DFL);
    std::signal(SIGTERM, SIG_DFL);
}

TEST(Interrupt, FirstSignalIsNoted) {
    take_signals_as_usual();
    catch_interrupts();
    for (const int signal : {SIGINT, SIGTERM}) {
        EXPECT_FALSE(interrupted());
        std::raise(signal);
        EXPECT_TRUE(interrupted());
        forget_interrupt();
    }
    EXPECT_FALSE(interrupted());
    take_signals_as_usual();
}

TEST(InterruptDeathTest, SecondSignalEndsTheProgramAtOnce) {
    const auto twice = [](int signal) {
        take_signals_as_usual();
        catch_interrupts();
        std::raise(signal);
        std::raise(signal);
    };
    EXPECT_EXIT(twice(SIGINT), ::testing::ExitedWithCode(130), "");
    EXPECT_EXIT(twice(SIGTERM), ::testing::ExitedWithCode(143), "");
}

TEST(Interrupt, AnIgnoredSignalStaysIgnored) {
    std::signal(SIGINT, SIG_IGN);
    catch_interrupts();
    std::raise(SIGINT);
    EXPECT_FALSE(interrupted());
    take_signals_as_usual();
}

} // namespace
