#include "base/interrupt.hpp"
#include "support/expect_error.hpp"
#include <csignal>

using namespace argand;
using namespace argand::testing;

namespace {

TEST(Interrupt, FirstSignalIsNoted) {
    catch_interrupts();
    for (const int signal : {SIGINT, SIGTERM}) {
        EXPECT_FALSE(interrupted());
        EXPECT_NO_THROW(stop_if_interrupted("rendering"));
        std::raise(signal);
        EXPECT_TRUE(interrupted());
        EXPECT_EQ(error_of([] { stop_if_interrupted("rendering"); }), "interrupted while rendering");
        forget_interrupt();
    }
    EXPECT_FALSE(interrupted());
    std::signal(SIGINT, SIG_DFL);
    std::signal(SIGTERM, SIG_DFL);
}

TEST(InterruptDeathTest, SecondSignalEndsTheProgramAtOnce) {
    const auto twice = [](int signal) {
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
    std::signal(SIGINT, SIG_DFL);
    std::signal(SIGTERM, SIG_DFL);
}

} // namespace
