// What is promised to C++ of a kernel's binding.
#include "shader_compile/fixture.hpp"

namespace argand::shader_compile {
namespace {

using testing::HasSubstr;
using testing::Not;

const std::string records = R"(#ifndef RECORDS_H
#define RECORDS_H
#include "shared/prelude.h"
ARGAND_SHARED_BEGIN
struct Light { vec4 position; vec4 power; };
struct EmitParams { float scale; uint count; uint pad[2]; };
ARGAND_SHARED_END
#endif
)";

const std::string kernel = head + R"(#include "shared/records.h"
// buffer Rays is declared below; layout(constant_id = 9) const uint not_this = 1;
layout(constant_id = 3) const uint max_depth = 8;
layout(constant_id = 0) const float x = 1.0;
layout(constant_id = 7) const bool b = true;
layout(constant_id = 5) const int least = -2147483647 - 1;
layout(constant_id = 6) const float never_read = 0.1;
layout(set = 0, binding = 2) buffer Sums { uint sums; };
layout(set = 0, binding = 0) readonly buffer Lights { Light lights[]; };
layout(set = 0, binding = 1) writeonly buffer Rays { uint ray_count; vec4 rays[]; };
layout(set = 0, binding = 3) readonly buffer Unused { uint unused[]; };
layout(push_constant) uniform Push { EmitParams params; };

float line(float t) { return t * x + params.scale; }

void main() {
    float v = line(lights[THREAD_INDEX].power.x) + mix(params.scale, 3.0, lights[0].power.y);
    for (uint i = 0; i < max_depth; ++i) {
        v += dot(lights[i].power, lights[i].position);
    }
    if (b) {
        rays[THREAD_INDEX] = vec4(v, cross(lights[0].power.xyz, lights[1].power.xyz)) * float(least);
    }
    atomicAdd(sums, 1u);
}
)";

/// A kernel with everything a kernel may have.
struct Binding : ShaderCompile {
    void SetUp() override {
        ShaderCompile::SetUp();
        write("shaders/shared/records.h", records);
        write("shaders/comp/photon/emit.comp", kernel);
        const Outcome outcome = compile("shaders/comp/photon/emit.comp");
        ASSERT_EQ(outcome.status, 0) << outcome.said;
        ASSERT_EQ(outcome.said, "");
    }
};

/// The text of the generated header between two brackets, white space made one space.
std::string struct_text(const std::string& header) {
    const std::size_t begin = header.find("struct emit {");
    std::string text;
    for (const char c : header.substr(begin == std::string::npos ? 0 : begin)) {
        const bool blank = c == ' ' || c == '\n';
        if (!blank || (!text.empty() && text.back() != ' ')) {
            text += blank ? ' ' : c;
        }
    }
    return text;
}

TEST_F(Binding, HeaderNamesWhatTheShaderDeclares) {
    const std::string header = generated("emit.hpp");
    EXPECT_THAT(header, HasSubstr("#pragma once"));
    EXPECT_THAT(header,
                HasSubstr("#include \"device/kernel.hpp\"\n#include \"shared/records.h\"\n"));
    EXPECT_THAT(header, HasSubstr("/// shaders/comp/photon/emit.comp\nstruct emit {"));
    EXPECT_EQ(
        struct_text(header),
        "struct emit { Read lights; ///< binding 0 Write rays; ///< binding 1 ReadWrite sums; ///< "
        "binding 2 "
        "Read unused; ///< binding 3 EmitParams params = missing_push_constants<EmitParams>(); "
        "struct Constants { float x = 1.0f; std::uint32_t max_depth = 8u; "
        "std::int32_t least = -2147483648; float never_read = 0.1f; bool b = true; } constants = "
        "{}; "
        "static const KernelInfo info; KernelArguments arguments() const; }; } // namespace "
        "argand::kernels ");
}

TEST_F(Binding, SourceCompilesWithoutWarning) {
    const Outcome outcome = check_cpp_file("out/kernels/emit.cpp");
    EXPECT_EQ(outcome.status, 0) << outcome.said;
}

const std::string before = R"(#include "kernels/emit.hpp"
argand::KernelArguments f(const argand::Buffer& a, const argand::Buffer& b) {
    return argand::kernels::emit)";

TEST_F(Binding, ProgramWithAllArgumentsCompiles) {
    const Outcome outcome = check_cpp(
        before + R"({.lights = a, .rays = argand::BufferView(b, 16, 32), .sums = a, .unused = b,
        .params = {.scale = 1, .count = 2, .pad = {}}, .constants = {.max_depth = 3}}.arguments();
    })");
    EXPECT_EQ(outcome.status, 0) << outcome.said;
}

TEST_F(Binding, ProgramThatLacksABufferDoesNotCompile) {
    const Outcome outcome =
        check_cpp(before + "{.lights = a, .rays = b, .sums = a, .params = {}}.arguments(); }");
    EXPECT_NE(outcome.status, 0);
    EXPECT_THAT(outcome.said, HasSubstr("unused"));
}

TEST_F(Binding, ProgramThatLacksPushConstantsDoesNotCompile) {
    write("program.cpp",
          before + "{.lights = a, .rays = b, .sums = a, .unused = b}.arguments(); }");
    const Outcome outcome =
        run("cd " + root.string() +
            " && " ARGAND_CXX_COMPILER " -std=c++20 -Iout -Ishaders -I" ARGAND_SOURCE_DIR
            "/engine -c program.cpp -o program.o");
    EXPECT_NE(outcome.status, 0);
    EXPECT_THAT(outcome.said, HasSubstr("a kernel lacks its push constants"));
}

TEST_F(Binding, ProgramWithAWrongNameOrTypeDoesNotCompile) {
    const Outcome name = check_cpp(
        before + "{.lights = a, .rays = b, .sum = a, .unused = b, .params = {}}.arguments(); }");
    EXPECT_NE(name.status, 0);
    EXPECT_THAT(name.said, HasSubstr("sum"));
    const Outcome type = check_cpp(
        before + "{.lights = a, .rays = b, .sums = a, .unused = b, .params = 3}.arguments(); }");
    EXPECT_NE(type.status, 0);
    EXPECT_THAT(type.said, HasSubstr("EmitParams"));
}

TEST_F(Binding, SourceChecksThatHostAndGpuAgreeOnRecords) {
    const std::string source = generated("emit.cpp");
    for (const char* check : {"sizeof(EmitParams) == 16", "offsetof(EmitParams, pad) == 8",
                              "sizeof(Light) == 32", "offsetof(Light, power) == 16"}) {
        EXPECT_THAT(source, HasSubstr(check));
    }
    // The checks bite: the same source does not compile against a header whose C++ layout differs.
    std::string moved = records;
    moved.replace(moved.find("vec4 position"), 4, "vec3");
    write("shaders/shared/records.h", moved);
    const Outcome outcome = check_cpp_file("out/kernels/emit.cpp");
    EXPECT_NE(outcome.status, 0);
    EXPECT_THAT(outcome.said, HasSubstr("Light has another size on the GPU"));
}

TEST_F(Binding, RecordThatCppLaysOutOtherwiseDoesNotCompile) {
    std::string trap = records;
    trap.replace(trap.find("vec4 position; vec4 power"), 25, "vec3 position; vec4 power");
    write("shaders/shared/records.h", trap);
    ASSERT_EQ(compile("shaders/comp/photon/emit.comp").status, 1) << "dot of vec4 and vec3";
    std::string body = kernel;
    body.replace(body.find("lights[i].power, lights[i].position"), 35,
                 "lights[i].power.xyz, lights[i].position");
    write("shaders/comp/photon/emit.comp", body);
    ASSERT_EQ(compile("shaders/comp/photon/emit.comp").status, 0);
    EXPECT_THAT(check_cpp_file("out/kernels/emit.cpp").said, HasSubstr("on the GPU"));
}

TEST_F(Binding, DepfileListsTheKernelAndEveryInclude) {
    const std::string depfile = generated("depfile.d");
    EXPECT_THAT(depfile, testing::StartsWith("out/kernels/emit.hpp out/kernels/emit.cpp:"));
    for (const char* file :
         {"comp/photon/emit.comp", "comp/kernel.glsl", "shared/prelude.h", "shared/records.h"}) {
        EXPECT_THAT(depfile, HasSubstr((root / "shaders" / file).string()));
    }
}

TEST_F(Binding, OutputThatWouldNotChangeIsLeftAlone) {
    const auto header = root / "out/kernels/emit.hpp";
    const auto source = root / "out/kernels/emit.cpp";
    fs::last_write_time(header, fs::file_time_type::clock::now() - std::chrono::hours(1));
    fs::last_write_time(source, fs::file_time_type::clock::now() - std::chrono::hours(1));
    const auto header_time = fs::last_write_time(header);
    const auto source_time = fs::last_write_time(source);
    std::string body = kernel;
    body.replace(body.find("atomicAdd(sums, 1u)"), 19, "atomicAdd(sums, 2u)");
    write("shaders/comp/photon/emit.comp", body);
    ASSERT_EQ(compile("shaders/comp/photon/emit.comp").status, 0);
    EXPECT_EQ(fs::last_write_time(header), header_time);
    EXPECT_NE(fs::last_write_time(source), source_time);
}

TEST_F(ShaderCompile, KernelWithoutArgumentsCompiles) {
    write("shaders/comp/nothing.comp",
          "#version 460\nlayout(local_size_x = 4, local_size_y = 2) in;\nvoid main() {}\n");
    const Outcome outcome = compile("shaders/comp/nothing.comp");
    ASSERT_EQ(outcome.status, 0) << outcome.said;
    EXPECT_THAT(generated("nothing.hpp"), Not(HasSubstr("Constants")));
    EXPECT_THAT(generated("nothing.cpp"), HasSubstr(".local_size = {4, 2, 1}"));
    const Outcome checked = check_cpp_file("out/kernels/nothing.cpp");
    EXPECT_EQ(checked.status, 0) << checked.said;
}

TEST_F(ShaderCompile, IncludesBesideTheKernelAndNested) {
    write("shaders/comp/a/user.comp",
          head + "#include \"near.glsl\"\n#include \"near.glsl\"\nvoid main() {}\n");
    write("shaders/comp/a/near.glsl", "#include \"sub/deep.glsl\"\n");
    write("shaders/comp/a/sub/deep.glsl", "// nothing\n");
    const Outcome outcome = compile("shaders/comp/a/user.comp");
    ASSERT_EQ(outcome.status, 0) << outcome.said;
    EXPECT_THAT(generated("depfile.d"), HasSubstr("shaders/comp/a/sub/deep.glsl"));
}

TEST_F(ShaderCompile, WarningIsShownWithFileAndLine) {
    const Outcome outcome = compile_body("#extension GL_XX_unheard_of : enable\nvoid main() {}\n");
    EXPECT_EQ(outcome.status, 0);
    EXPECT_THAT(outcome.said, testing::StartsWith("shaders/comp/test/bad.comp:4: warning: "));
}

} // namespace
} // namespace argand::shader_compile
