// Raster programs: NAME.vert and NAME.frag become one struct.
#include "shader_compile/fixture.hpp"

namespace argand::shader_compile {
namespace {

using testing::HasSubstr;

struct RasterProgram : ShaderCompile {
    const std::string start = "#version 460\n#include \"kernel.glsl\"\n#include \"both.glsl\"\n";
    std::string both = "layout(set = 0, binding = 0) readonly buffer Corners { vec4 corners[]; };\n"
                       "layout(set = 0, binding = 1) readonly buffer Colors { uint colors[]; };\n"
                       "layout(constant_id = 0) const uint added = 3u;\n";
    std::string vertex = "void main() { gl_Position = corners[gl_VertexIndex]; }\n";
    std::string fragment = "layout(location = 0) out uvec2 result;\n"
                           "void main() { result = uvec2(colors[0], added); }\n";

    Outcome compile_both() const {
        write("shaders/raster/both.glsl", both);
        write("shaders/raster/show.vert", start + vertex);
        write("shaders/raster/show.frag", start + fragment);
        return compile("shaders/raster/show.vert");
    }
};

TEST_F(RasterProgram, IsOneStruct) {
    ASSERT_EQ(compile_both().said, "");
    EXPECT_THAT(generated("show.hpp"), HasSubstr("static const RasterInfo info;"));
    EXPECT_THAT(generated("show.cpp"), HasSubstr(".words = 2,"));
    EXPECT_THAT(generated("depfile.d"), HasSubstr("show.vert"));
    EXPECT_THAT(generated("depfile.d"), HasSubstr("show.frag"));
    const Outcome source = check_cpp_file("out/kernels/show.cpp");
    EXPECT_EQ(source.status, 0) << source.said;
    const Outcome use =
        check_cpp("#include \"kernels/show.hpp\"\n"
                  "using namespace argand;\n"
                  "KernelArguments f(const Buffer& a, const Buffer& b) {\n"
                  "    return kernels::show{.corners = a, .colors = b,\n"
                  "                         .constants = {.added = 4}}.arguments();\n}\n");
    EXPECT_EQ(use.status, 0) << use.said;
}

TEST_F(RasterProgram, DoesNotWriteBuffers) {
    both = "layout(set = 0, binding = 0) readonly buffer Corners { vec4 corners[]; };\n"
           "layout(set = 0, binding = 1) buffer Colors { uint colors[]; };\n"
           "const uint added = 3u;\n";
    const Outcome outcome = compile_both();
    EXPECT_EQ(outcome.status, 1);
    EXPECT_THAT(outcome.said, HasSubstr("buffer colors is not readonly"));
}

TEST_F(RasterProgram, ReadsItsVerticesFromBuffers) {
    vertex = "layout(location = 0) in vec4 place;\nvoid main() { gl_Position = place; }\n";
    EXPECT_THAT(compile_both().said,
                HasSubstr("show.vert:4: error: input place: a vertex shader reads its vertices "
                          "from buffers"));
}

TEST_F(RasterProgram, HasOneOutputOfUnsignedWords) {
    for (const char* output : {"out vec4 result;\nvoid main() { result = vec4(1.0); }\n",
                               "out uvec3 result;\nvoid main() { result = uvec3(added); }\n",
                               "out uint result;\nlayout(location = 1) out uint more;\n"
                               "void main() { result = more = added; }\n"}) {
        fragment = std::string("layout(location = 0) ") + output;
        EXPECT_THAT(compile_both().said,
                    HasSubstr("a fragment shader has one output, of type uint, uvec2 or uvec4"));
    }
    fragment = "void main() {}\n";
    EXPECT_THAT(compile_both().said, HasSubstr("show.frag:1: error: a fragment shader has one"));
}

TEST_F(RasterProgram, DeclaresTheSameInBothShaders) {
    fragment = "layout(set = 0, binding = 2) readonly buffer More { uint more[]; };\n"
               "layout(location = 0) out uint result;\nvoid main() { result = more[0]; }\n";
    EXPECT_THAT(compile_both().said,
                HasSubstr("show.frag:1: error: it declares other buffers or constants than "
                          "shaders/raster/show.vert"));
}

TEST_F(RasterProgram, NeedsItsFragmentShader) {
    ASSERT_EQ(compile_both().status, 0);
    fs::remove(root / "shaders/raster/show.frag");
    const Outcome outcome = compile("shaders/raster/show.vert");
    EXPECT_EQ(outcome.status, 1);
    EXPECT_THAT(outcome.said, HasSubstr("shaders/raster/show.frag"));
}

} // namespace
} // namespace argand::shader_compile
