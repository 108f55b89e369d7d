// Bad shaders: one line with file and line, exit status 1, and nothing written.
#include "shader_compile/fixture.hpp"

#include <algorithm>

namespace argand::shader_compile {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

struct BadShader : ShaderCompile {
    void expect_error(const Outcome& outcome, const std::string& start,
                      const std::string& reason) const {
        EXPECT_EQ(outcome.status, 1);
        EXPECT_THAT(outcome.said, StartsWith(start));
        EXPECT_THAT(outcome.said, HasSubstr(reason));
        EXPECT_EQ(std::count(outcome.said.begin(), outcome.said.end(), '\n'), 1) << outcome.said;
        EXPECT_TRUE(fs::is_empty(root / "out/kernels"));
    }
    void expect_body_error(const std::string& body, int line, const std::string& reason) const {
        expect_error(compile_body(body),
                     "shaders/comp/test/bad.comp:" + std::to_string(line) + ": error: ", reason);
    }
};

TEST_F(BadShader, SyntaxError) {
    expect_body_error("void main() {\n    int a = 1 +;\n}\n", 5, "syntax error");
    expect_body_error("void main() {\n    float a = nope;\n    float b = neither;\n}\n", 5,
                      "'nope' : undeclared identifier");
}

TEST_F(BadShader, NoMainFunction) {
    expect_body_error("void other() {}\n", 1, "Missing entry point");
}

TEST_F(BadShader, ErrorInAnInclude) {
    write("shaders/comp/test/near.glsl", "\n\nfloat f() {\n    return nowhere;\n}\n");
    write("shaders/comp/test/far.glsl", "\n#include \"near.glsl\"\n");
    expect_error(compile_body("#include \"far.glsl\"\nvoid main() {}\n"),
                 "shaders/comp/test/near.glsl:4: error: ", "'nowhere'");
}

TEST_F(BadShader, ErrorAfterAnInclude) {
    write("shaders/comp/test/near.glsl", "\n\n\n");
    expect_body_error("#include \"near.glsl\"\nvoid main() { nowhere; }\n", 5, "'nowhere'");
}

TEST_F(BadShader, MissingInclude) {
    expect_body_error("#include \"gone.glsl\"\nvoid main() {}\n", 4,
                      "cannot include gone.glsl: it is neither beside");
    write("shaders/comp/test/near.glsl", "\n#include \"gone.glsl\"\n");
    expect_error(compile_body("#include \"near.glsl\"\nvoid main() {}\n"),
                 "shaders/comp/test/near.glsl:2: error: ", "cannot include gone.glsl");
}

TEST_F(BadShader, IncludedDirectory) {
    fs::create_directories(root / "shaders/comp/test/folder");
    expect_body_error("#include \"folder\"\nvoid main() {}\n", 4, "it is a directory");
}

TEST_F(BadShader, IncludeCycle) {
    write("shaders/comp/test/one.glsl", "\n#include \"two.glsl\"\n");
    write("shaders/comp/test/two.glsl", "\n\n#include \"one.glsl\"\n");
    expect_error(
        compile_body("#include \"one.glsl\"\nvoid main() {}\n"),
        "shaders/comp/test/two.glsl:3: error: ",
        "cannot include one.glsl: it includes itself, by way of shaders/comp/test/two.glsl");
    expect_body_error("#include \"bad.comp\"\nvoid main() {}\n", 4, "it includes itself");
}

TEST_F(BadShader, NotAKernel) {
    write("shaders/comp/test/bad.comp", "");
    expect_error(compile("shaders/comp/test/bad.comp"),
                 "shaders/comp/test/bad.comp:1: error: ", "#version 460");
    write("shaders/comp/test/bad.comp", std::string("\0\xff\x80 #versio\n", 12));
    expect_error(compile("shaders/comp/test/bad.comp"),
                 "shaders/comp/test/bad.comp:1: error: ", "#version 460");
    expect_error(compile("shaders/comp/test/gone.comp"),
                 "cannot read 'shaders/comp/test/gone.comp': ", "no such file");
    expect_error(compile("shaders/comp/test"), "cannot read 'shaders/comp/test': ", "directory");
}

TEST_F(BadShader, NameThatIsNotOneInCpp) {
    write("shaders/comp/2d.comp", head + "void main() {}\n");
    expect_error(compile("shaders/comp/2d.comp"), "shaders/comp/2d.comp:1: error: ", "'2d'");
    write("shaders/comp/export.comp", head + "void main() {}\n");
    expect_error(compile("shaders/comp/export.comp"),
                 "shaders/comp/export.comp:1: error: ", "'export'");
}

TEST_F(BadShader, BufferNameThatIsTaken) {
    expect_body_error("layout(set = 0, binding = 0) buffer A { uint info[]; };\nvoid main() {}\n",
                      4, "'info'");
    expect_body_error("layout(set = 0, binding = 0) buffer A { uint new[]; };\nvoid main() {}\n", 4,
                      "'new'");
    expect_body_error("layout(set = 0, binding = 0) buffer A { uint x[]; } a;\n"
                      "layout(set = 0, binding = 1) buffer B { uint x[]; } b;\nvoid main() {}\n",
                      4, "'x'");
}

TEST_F(BadShader, Bindings) {
    const std::string first = "layout(set = 0, binding = 0) buffer A { uint a[]; };\n";
    expect_body_error(first +
                          "layout(set = 0, binding = 2) buffer B { uint b[]; };\nvoid main() {}\n",
                      5, "binding 2 but none has binding 1");
    expect_body_error(first +
                          "layout(set = 0, binding = 0) buffer B { uint b[]; };\nvoid main() {}\n",
                      5, "both have binding 0");
    expect_body_error(first +
                          "layout(set = 1, binding = 0) buffer B { uint b[]; };\nvoid main() {}\n",
                      5, "set 1");
    expect_body_error(
        "layout(set = 0, binding = 0) buffer A { uint a[]; } many[3];\nvoid main() {}\n", 4,
        "array of buffers");
    expect_body_error(
        "layout(set = 0, binding = 0) readonly writeonly buffer A { uint a[]; };\nvoid main() {}\n",
        4, "both readonly and writeonly");
    std::string many;
    for (int i = 0; i < 25; ++i) {
        const std::string n = std::to_string(i);
        many += "layout(set = 0, binding = " + n + ") buffer B" + n + " { uint b" + n + "[]; };\n";
    }
    expect_body_error(many + "void main() {}\n", 28, "one too many");
}

TEST_F(BadShader, ResourcesThatAreNotStorageBuffers) {
    expect_body_error("layout(set = 0, binding = 0) uniform Block { uint a; };\nvoid main() {}\n",
                      4, "uniform buffer");
    expect_body_error(
        "\nlayout(set = 0, binding = 0, r32f) uniform image2D picture;\nvoid main() {}\n", 5,
        "storage image 'picture'");
    expect_body_error("layout(set = 0, binding = 0) uniform sampler2D map;\nvoid main() {}\n", 4,
                      "sampled image");
}

TEST_F(BadShader, PushConstants) {
    write("shaders/shared/big.h", "struct Big { vec4 a[9]; };\nstruct Good { vec4 a; };\n");
    const std::string include = "#include \"shared/big.h\"\n";
    expect_body_error(include + "layout(push_constant) uniform P { Big big; };\nvoid main() {}\n",
                      5, "144 bytes; every device has room for 128");
    expect_body_error("struct Local { vec4 a; };\n// struct Local is for the GPU alone\n"
                      "layout(push_constant) uniform P { Local l; };\nvoid main() {}\n",
                      6, "no included header under shaders/shared/ declares struct Local");
    expect_body_error("layout(push_constant) uniform P { uint a; };\nvoid main() {}\n", 4,
                      "exactly one member");
    expect_body_error(include +
                          "layout(push_constant) uniform P { Good a; Good b; };\nvoid main() {}\n",
                      5, "exactly one member");
    expect_body_error(include + "layout(push_constant) uniform P { Good a[2]; };\nvoid main() {}\n",
                      5, "exactly one member");
}

TEST_F(BadShader, Specialization) {
    expect_body_error("layout(local_size_y_id = 3) in;\nvoid main() {}\n", 4, "local_size_y_id");
    expect_body_error("layout(constant_id = 0) const double wide = 1.0;\nvoid main() {}\n", 4,
                      "wide");
    std::string many;
    for (int i = 0; i < 17; ++i) {
        many += "layout(constant_id = " + std::to_string(i) + ") const uint c" + std::to_string(i) +
                " = 0;\n";
    }
    expect_body_error(many + "void main() {}\n", 20, "one too many");
}

TEST_F(BadShader, ErrorLeavesEarlierOutputAsItWas) {
    ASSERT_EQ(compile_body("void main() {}\n").status, 0);
    const std::string header = generated("bad.hpp");
    const std::string source = generated("bad.cpp");
    ASSERT_EQ(compile_body("void main() { nowhere; }\n").status, 1);
    EXPECT_EQ(generated("bad.hpp"), header);
    EXPECT_EQ(generated("bad.cpp"), source);
}

TEST_F(BadShader, UnwritableOutput) {
    write("good.comp", head + "void main() {}\n");
    const Outcome outcome =
        run("cd " + root.string() +
            " && " ARGAND_TOOL
            " -I shaders -I shaders/comp --out gone --depfile out/kernels/good.d good.comp");
    EXPECT_EQ(outcome.status, 1);
    EXPECT_THAT(outcome.said,
                StartsWith("cannot write 'gone/good.hpp': the directory 'gone' does not exist"));
}

TEST_F(ShaderCompile, UsageErrorsExitWithTwo) {
    for (const char* words :
         {"", "-I", "--what x.comp", "--out out x.comp", "--out out --depfile d a.comp b.comp"}) {
        const Outcome outcome = run(std::string(ARGAND_TOOL) + " " + words);
        EXPECT_EQ(outcome.status, 2) << words;
        EXPECT_THAT(outcome.said, HasSubstr("shader_compile"));
    }
}

} // namespace
} // namespace argand::shader_compile
