// The twin of a kernel, which other backends run: what is generated, and what is refused.
#include "shader_compile/fixture.hpp"

namespace argand::shader_compile {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

struct Twin : ShaderCompile {
    void SetUp() override {
        ShaderCompile::SetUp();
        write("shaders/cuda/kernel.h", read(fs::path(ARGAND_SOURCE_DIR) / "shaders/cuda/kernel.h"));
        write("shaders/comp/a/twice.comp",
              head + declarations + "#include \"shared/kernels/a/twice.h\"\n");
        write("shaders/shared/kernels/a/twice.h",
              "uint doubled(uint i) { return factor * numbers[i]; }\n"
              "void main() { numbers[THREAD_INDEX] = doubled(THREAD_INDEX); }\n");
    }
    const std::string declarations = "layout(set = 0, binding = 0) buffer A { uint numbers[]; };\n"
                                     "layout(constant_id = 0) const uint factor = 2;\n";
    Outcome compile_twin() const {
        return compile("--twin twice --write-twin shaders/comp/a/twice.comp");
    }
};

TEST_F(Twin, IsWrittenFromTheBodyThatTheKernelIncludes) {
    const Outcome outcome = compile_twin();
    ASSERT_EQ(outcome.status, 0) << outcome.said;
    EXPECT_THAT(generated("twice.cu"), HasSubstr("#include \"shared/kernels/a/twice.h\"\n"));
    EXPECT_THAT(generated("twice.cpp"), HasSubstr(".host = twin_twice"));
    EXPECT_THAT(generated("depfile.d"),
                HasSubstr("out/kernels/twice.twin.h out/kernels/twice.cu:"));
    const Outcome checked = check_cpp("#include \"kernels/twice.cu\"\n");
    EXPECT_EQ(checked.status, 0) << checked.said;
}

TEST_F(Twin, DoesNotCompileIfItsBodyNeedsMoreThanTheKernelDeclares) {
    write("shaders/comp/a/twice.comp",
          head + declarations +
              "layout(set = 0, binding = 1) buffer B { uint missing[]; };\n"
              "#define more missing[0]\n#include \"shared/kernels/a/twice.h\"\n");
    write("shaders/shared/kernels/a/twice.h", "void main() { numbers[THREAD_INDEX] = more; }\n");
    ASSERT_EQ(compile_twin().status, 0);
    EXPECT_THAT(check_cpp("#include \"kernels/twice.cu\"\n").said,
                HasSubstr("shaders/shared/kernels/a/twice.h:1:"));
}

TEST_F(Twin, OfTheModuleForPlainScenesLacksConstantsThatAreFalseThere) {
    write("shaders/comp/a/twice.comp",
          head + "layout(set = 0, binding = 0) buffer A { uint numbers[]; };\n"
                 "layout(constant_id = 0) const uint factor = 2;\n"
                 "#ifdef ARGAND_PLAIN\n"
                 "layout(constant_id = 1) const bool dear = false;\n"
                 "#else\n"
                 "layout(constant_id = 1) const bool dear = true;\n"
                 "#endif\n"
                 "#include \"shared/kernels/a/twice.h\"\n");
    write("shaders/shared/kernels/a/twice.h",
          "void main() {\n"
          "    numbers[THREAD_INDEX] *= factor;\n"
          "    if (dear) { numbers[THREAD_INDEX] += numbers[numbers[THREAD_INDEX]] % 7u; }\n"
          "}\n");
    const std::string options = "--twin twice --write-twin --plain-twin ";
    const Outcome outcome = compile(options + "shaders/comp/a/twice.comp");
    ASSERT_EQ(outcome.status, 0) << outcome.said;
    EXPECT_THAT(generated("twice.plain.cu"), HasSubstr("#define ARGAND_PLAIN\n"));
    EXPECT_THAT(generated("twice.cpp"), HasSubstr(".host = twin_twice_plain"));
    EXPECT_THAT(generated("twice.cpp"), HasSubstr(".host = twin_twice,"));
    EXPECT_THAT(generated("depfile.d"), HasSubstr("out/kernels/twice.plain.cu:"));
    for (const char* twin : {"twice.cu", "twice.plain.cu"}) {
        const Outcome checked = check_cpp(std::string("#include \"kernels/") + twin + "\"\n");
        EXPECT_EQ(checked.status, 0) << checked.said;
    }
    // The constant is no argument of the plain twin.
    EXPECT_NE(check_cpp("#include \"kernels/twice.plain.cu\"\n"
                        "static_assert(argand::plain_twins::twice::dear);\n")
                  .status,
              0);
    EXPECT_EQ(check_cpp("#include \"kernels/twice.plain.cu\"\n"
                        "static_assert(!argand::plain_twins::twice::dear);\n")
                  .status,
              0);
}

TEST_F(Twin, KernelWithoutAModuleForPlainScenesHasNoTwinForThem) {
    const Outcome outcome =
        compile("--twin twice --write-twin --plain-twin shaders/comp/a/twice.comp");
    EXPECT_EQ(outcome.status, 1);
    EXPECT_THAT(
        outcome.said,
        HasSubstr("shaders/comp/a/twice.comp:1: error: its module for ARGAND_PLAIN is missing"));
    for (const char* options : {"--plain-twin", "--write-twin", "--twin twice --plain-twin"}) {
        EXPECT_THAT(compile(std::string(options) + " shaders/comp/a/twice.comp").said,
                    StartsWith("usage: shader_compile"));
    }
}

TEST_F(Twin, KernelWithoutABodyIsAnError) {
    write("shaders/comp/a/twice.comp", head + declarations + "void main() {}\n");
    const Outcome outcome = compile_twin();
    EXPECT_EQ(outcome.status, 1);
    EXPECT_THAT(outcome.said, StartsWith("shaders/comp/a/twice.comp:1: error: "));
    EXPECT_THAT(outcome.said, HasSubstr("shaders/shared/kernels/.../twice.h"));
    EXPECT_TRUE(fs::is_empty(root / "out/kernels"));
}

} // namespace
} // namespace argand::shader_compile
