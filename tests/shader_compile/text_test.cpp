#include "emit.hpp"
#include "names.hpp"
#include "sources.hpp"

#include <gtest/gtest.h>

namespace argand::shader_compile {
namespace {

TEST(Sources, CommentsBecomeBlanksAndLinesStay) {
    EXPECT_EQ(without_comments("a // b\nc /* d\n */ e / f"), "a     \nc     \n    e / f");
    EXPECT_EQ(without_comments("a /*/ b */ c"), "a          c");
    EXPECT_EQ(without_comments("a //"), "a   ");
    EXPECT_EQ(without_comments("a /*"), "a   ");
    EXPECT_EQ(without_comments(""), "");
}

TEST(Sources, LineOfWords) {
    const std::string text = "buffer Lightest\nbufferLight buffer\n Light {";
    EXPECT_EQ(line_of(text, {"buffer", "Light"}), 2);
    EXPECT_EQ(line_of(text, {"Light", "{"}), 3);
    EXPECT_EQ(line_of(text, {"buffer", "Lights"}), std::nullopt);
    EXPECT_EQ(line_of("", {"x"}), std::nullopt);
}

TEST(Sources, ErrorPlaceIsTheFirstSourceThatSaysIt) {
    const Sources sources{
        {"k.comp", "// struct A {\n"}, {"a.h", "\nstruct A {};"}, {"b.h", "struct A {};"}};
    EXPECT_EQ(error_at(sources, {"struct", "A"}), "a.h:2: error: ");
    EXPECT_EQ(error_at(sources, {"struct", "B"}), "k.comp:1: error: ");
}

TEST(Names, OfCpp) {
    EXPECT_TRUE(is_cpp_name("photon_emit2"));
    for (const char* name : {"", "2d", "a-b", "a.b", "new", "operator", "\xc3\xa4"}) {
        EXPECT_FALSE(is_cpp_name(name)) << name;
    }
}

TEST(Depfile, EscapesWhatMakeWouldRead) {
    EXPECT_EQ(emit_depfile({"out/a.hpp", "out/a.cpp"}, {"/my files/a#1.comp", "/b$.h"}),
              "out/a.hpp out/a.cpp: \\\n  /my\\ files/a\\#1.comp \\\n  /b$$.h\n");
}

} // namespace
} // namespace argand::shader_compile
