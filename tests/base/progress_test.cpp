#include "base/progress.hpp"
#include "support/terminal.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <limits>
#include <string>
#include <termios.h>
#include <unistd.h>

using argand::Progress;
using argand::progress_line;
using argand::testing::Terminal;
using ::testing::EndsWith;
using ::testing::HasSubstr;

namespace {

TEST(Progress, LineShowsShareAndTimeLeft) {
    EXPECT_EQ(progress_line("tracing", 0, 0), "tracing  0 %");
    EXPECT_EQ(progress_line("tracing", 0.25, 10), "tracing  25 %  30 s left");
    EXPECT_EQ(progress_line("tracing", 0.5, 90), "tracing  50 %  1 min 30 s left");
    EXPECT_EQ(progress_line("tracing", 0.5, 3720), "tracing  50 %  1 h 02 min left");
    EXPECT_EQ(progress_line("tracing", 1, 10), "tracing  100 %");
    EXPECT_EQ(progress_line("tracing", 0.25, 10, "pass 3, radius 0.1"),
              "tracing  25 %  30 s left  pass 3, radius 0.1");
    EXPECT_EQ(progress_line("tracing", 7, 10), "tracing  100 %");
    EXPECT_EQ(progress_line("tracing", -1, 10), "tracing  0 %");
    EXPECT_EQ(progress_line("tracing", std::numeric_limits<double>::quiet_NaN(), 10),
              "tracing  0 %");
}

TEST(Progress, DrawsOnATerminalAndErasesItself) {
    const Terminal terminal;
    ASSERT_GE(terminal.descriptor(), 0);
    {
        Progress progress("tracing", false, terminal.descriptor());
        progress.update(0.5);
        EXPECT_THAT(terminal.read(), HasSubstr("tracing  50 %"));
    }
    EXPECT_THAT(terminal.read(), EndsWith("\r\x1b[K"));
}

TEST(Progress, DrawsAtMostTenTimesASecond) {
    const Terminal terminal;
    ASSERT_GE(terminal.descriptor(), 0);
    const auto start = std::chrono::steady_clock::now();
    Progress progress("tracing", false, terminal.descriptor());
    for (int i = 0; i < 100000; ++i) {
        progress.update(i * 1e-5);
    }
    const double seconds =
        std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    const std::string drawn = terminal.read();
    EXPECT_LE(static_cast<double>(std::count(drawn.begin(), drawn.end(), '\r')), 2 + seconds * 10);
}

TEST(Progress, IsSilentWhenQuietOrWithoutATerminal) {
    const Terminal terminal;
    ASSERT_GE(terminal.descriptor(), 0);
    {
        Progress progress("tracing", true, terminal.descriptor());
        progress.update(0.5);
    }
    EXPECT_EQ(terminal.read(), "");

    int ends[2];
    ASSERT_EQ(::pipe2(ends, O_NONBLOCK), 0);
    {
        Progress progress("tracing", false, ends[1]);
        progress.update(0.5);
    }
    char byte = 0;
    EXPECT_EQ(::read(ends[0], &byte, 1), -1);
    ::close(ends[0]);
    ::close(ends[1]);
}

} // namespace
