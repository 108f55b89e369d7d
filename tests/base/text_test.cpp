#include "base/text.hpp"

#include <gtest/gtest.h>

namespace argand {
namespace {

TEST(OneLine, KeepsAPlainLine) { EXPECT_EQ(one_line("a plain line"), "a plain line"); }

TEST(OneLine, FoldsWhiteSpaceAndControlCharacters) {
    EXPECT_EQ(one_line(" \n a\r\n\tb \x1b[31m c\x7f\n"), "a b [31m c");
    EXPECT_EQ(one_line("a\xc2\x85"
                       "b"),
              "a b"); // U+0085, a line break in some terminals
    EXPECT_EQ(one_line(""), "");
    EXPECT_EQ(one_line("\n\n"), "");
}

TEST(OneLine, KeepsUtf8AndReplacesOtherBytes) {
    EXPECT_EQ(one_line("\u2764\u267b \U0001f600 é"), "\u2764\u267b \U0001f600 é");
    EXPECT_EQ(one_line("a\xff"
                       "b\xc3"),
              "a?b?");
    EXPECT_EQ(one_line("\xc0\xaf"), "??");           // overlong '/'
    EXPECT_EQ(one_line("\xe0\x80\xaf"), "???");      // overlong
    EXPECT_EQ(one_line("\xed\xa0\x80"), "???");      // surrogate
    EXPECT_EQ(one_line("\xf4\x90\x80\x80"), "????"); // beyond U+10FFFF
}

TEST(OneLine, TruncatesBetweenCharacters) {
    EXPECT_EQ(one_line("abcdef", 6), "abcdef");
    EXPECT_EQ(one_line("abcdefg", 6), "abcdef...");
    EXPECT_EQ(one_line("ab\u2764", 4), "ab...");
    EXPECT_EQ(one_line("ab\u2764", 5), "ab\u2764");
    EXPECT_EQ(one_line("abcd e", 5), "abcd...");
}

} // namespace
} // namespace argand
