// Annotations: what a kernel's source tells compare-backends of its buffers.
#include "shader_compile/fixture.hpp"

namespace argand::shader_compile {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

struct Annotations : ShaderCompile {
    void SetUp() override {
        ShaderCompile::SetUp();
        write("shaders/shared/records.h", "#ifndef RECORDS_H\n"
                                          "#define RECORDS_H\n"
                                          "#include \"shared/prelude.h\"\n"
                                          "ARGAND_SHARED_BEGIN\n"
                                          "CONSTANT uint log_head = 2u;\n"
                                          "// Of one record.\n"
                                          "CONSTANT uint log_stride = 4u + 62u;\n"
                                          "struct Node { float32 x, y; uint a; // a child\n"
                                          "    uint b; };\n"
                                          "struct Pair { float32 x; uint a; float32 y; uint b; };\n"
                                          "struct Box { vec4 low, high; };\n"
                                          "ARGAND_SHARED_END\n"
                                          "#endif\n");
    }
    /// The annotation is line 5.
    Outcome compile_with(const std::string& annotation) const {
        return compile_body(
            "#include \"shared/records.h\"\n" + annotation +
            "\nlayout(set = 0, binding = 0) buffer A { uvec2 nodes[]; };\n"
            "layout(set = 0, binding = 1) buffer B { uint words[]; };\n"
            "layout(set = 0, binding = 2) readonly buffer C { uint input_words[]; };\n"
            "void main() { words[0] = nodes[0].x + input_words[0]; }\n");
    }
    void expect_bindings(const std::string& annotation, const std::string& text) const {
        const Outcome outcome = compile_with(annotation);
        ASSERT_EQ(outcome.status, 0) << outcome.said;
        EXPECT_THAT(generated("bad.cpp"), HasSubstr(text));
        const Outcome checked = check_cpp_file("out/kernels/bad.cpp");
        EXPECT_EQ(checked.status, 0) << checked.said;
    }
    void expect_error(const std::string& annotation, const std::string& reason) const {
        const Outcome outcome = compile_with(annotation);
        EXPECT_EQ(outcome.status, 1) << annotation;
        EXPECT_THAT(outcome.said, StartsWith("shaders/comp/test/bad.comp:5: error: "));
        EXPECT_THAT(outcome.said, HasSubstr(reason));
    }
};

TEST_F(Annotations, HoldsTakesTheWordsOfARecord) {
    expect_bindings("//@ holds(nodes, Node)", "\"nodes\", .binding = 0, .access = "
                                              "Access::read_write, .words = \"ffuu\"}");
}

TEST_F(Annotations, HoldsKeepsElementsThatLookAlike) {
    expect_bindings("  //@holds( nodes,Pair )", ".access = Access::read_write, .words = \"fu\"}");
}

TEST_F(Annotations, UnorderedRefersToSharedConstants) {
    expect_bindings("//@ unordered(words, log_head, log_stride)",
                    ".unordered = {.head = log_head, .stride = log_stride}}");
    expect_bindings("//@ unordered(words, 0, 1)", ".unordered = {.head = 0, .stride = 1}}");
}

TEST_F(Annotations, IncidentalAndReferring) {
    expect_bindings("//@ incidental(words)", ".words = \"u\", .incidental = true}");
    expect_bindings("//@ refers(words, nodes)", ".words = \"u\", .refers_to = 0}");
}

TEST_F(Annotations, WrongOnesAreErrorsWithFileAndLine) {
    expect_error("//@ incidental(gone)", "'gone', but the kernel declares no such buffer");
    expect_error("//@ incidental(input_words)", "'input_words', which the kernel only reads");
    expect_error("//@ incidental(words, nodes)", "incidental takes a buffer");
    expect_error("//@ refers(words)", "refers takes two buffers");
    expect_error("//@ refers(words, gone)", "'gone'");
    expect_error("//@ sorted(words)", "there is no annotation 'sorted'");
    expect_error("//@ incidental words", "an annotation is a line //@ name(argument, ...)");
    expect_error("//@ unordered(words, 0, gone)", "'gone', but no included header");
    expect_error("//@ holds(nodes, Gone)", "'Gone', but no included header");
    expect_error("//@ holds(nodes, Box)", "members of Box are not all float32 and uint");
}

TEST_F(Annotations, OfAnIncludedFileAreReportedThere) {
    write("shaders/comp/test/near.glsl",
          "layout(set = 0, binding = 0) buffer A { uint a[]; };\n//@ incidental(b)\n");
    const Outcome outcome = compile_body("#include \"near.glsl\"\nvoid main() { a[0] = 1u; }\n");
    EXPECT_THAT(outcome.said, StartsWith("shaders/comp/test/near.glsl:2: error: "));
}

} // namespace
} // namespace argand::shader_compile
