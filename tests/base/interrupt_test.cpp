#include "base/interrupt.hpp"

#include <chrono>
#include <csignal>
#include <gtest/gtest.h>
#include <thread>

using namespace argand;

namespace {

/// Restores the default handling of the signals, which the test's parent may have changed: a
/// background job ignores SIGINT.
void restore_default_signals() {
    std::signal(SIGINT, SIG_DFL);
    std::signal(SIGTERM, SIG_DFL);
}

TEST(Interrupt, FirstSignalSetsTheFlag) {
    restore_default_signals();
    catch_interrupts();
    for (const int signal : {SIGINT, SIGTERM}) {
        EXPECT_FALSE(interrupted());
        std::raise(signal);
        EXPECT_TRUE(interrupted());
        std::raise(signal); // `timeout` sends its signal twice
        EXPECT_TRUE(interrupted());
        forget_interrupt();
    }
    EXPECT_FALSE(interrupted());
    restore_default_signals();
}

TEST(InterruptDeathTest, LaterSignalEndsTheProgramAtOnce) {
    const auto twice = [](int signal) {
        restore_default_signals();
        catch_interrupts();
        std::raise(signal);
        std::this_thread::sleep_for(std::chrono::milliseconds(600));
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
    restore_default_signals();
}

} // namespace
