// argand_add_kernels() in a project of its own: what is built again, and what fails.
#include "shader_compile/fixture.hpp"

namespace argand::shader_compile {
namespace {

using testing::HasSubstr;
using testing::Not;

struct BuildSlow : ShaderCompile {
    void SetUp() override {
        ShaderCompile::SetUp();
        write("CMakeLists.txt", R"(cmake_minimum_required(VERSION 3.25)
project(kernels CXX)
set(CMAKE_CXX_STANDARD 20)
add_executable(shader_compile IMPORTED GLOBAL)
set_target_properties(shader_compile PROPERTIES IMPORTED_LOCATION )" ARGAND_TOOL R"()
include()" ARGAND_SOURCE_DIR R"(/tools/shader_compile/kernels.cmake)
file(GLOB_RECURSE kernels shaders/comp/*.comp)
add_library(library STATIC user.cpp)
argand_add_kernels(library ${TWINS} ${kernels})
get_property(twins GLOBAL PROPERTY ARGAND_TWINS)
message(STATUS "Twins: ${twins}")
target_include_directories(library PUBLIC shaders )" ARGAND_SOURCE_DIR R"(/engine)
)");
        write("user.cpp", "#include \"kernels/copy.hpp\"\n"
                          "const char* name() { return argand::kernels::copy::info.name; }\n");
        write("shaders/comp/a/copy.comp",
              head + "#include \"one.glsl\"\n"
                     "layout(set = 0, binding = 0) buffer A { uint a[]; };\n"
                     "void main() { a[THREAD_INDEX] = one(); }\n");
        write("shaders/comp/a/one.glsl", "uint one() { return 1u; }\n");
    }
    Outcome configure(const std::string& options = "") const {
        return run(ARGAND_CMAKE " -G Ninja -DCMAKE_CXX_COMPILER=" ARGAND_CXX_COMPILER " -S " +
                   root.string() + " -B " + (root / "build").string() + " " + options);
    }
    Outcome configure_with_twins() const {
        fs::create_directories(root / "shaders/cuda");
        return configure("'-DTWINS=TWINS;" + (root / "shaders/cuda").string() + "'");
    }
    Outcome build() const { return run(ARGAND_CMAKE " --build " + (root / "build").string()); }
};

TEST_F(BuildSlow, FollowsIncludesAndFailsOnErrors) {
    ASSERT_EQ(configure().status, 0);
    Outcome outcome = build();
    ASSERT_EQ(outcome.status, 0) << outcome.said;
    EXPECT_THAT(outcome.said, HasSubstr("Compiling kernel shaders/comp/a/copy.comp"));
    EXPECT_THAT(build().said, HasSubstr("no work to do"));

    // The interface stays: the kernel is compiled again, what uses its header is not.
    write("shaders/comp/a/one.glsl", "uint one() { return 2u; }\n");
    outcome = build();
    EXPECT_EQ(outcome.status, 0) << outcome.said;
    EXPECT_THAT(outcome.said, HasSubstr("Compiling kernel"));
    EXPECT_THAT(outcome.said, Not(HasSubstr("user.cpp")));

    write("shaders/comp/a/one.glsl", "uint one() { return nowhere; }\n");
    outcome = build();
    EXPECT_NE(outcome.status, 0);
    EXPECT_THAT(outcome.said, HasSubstr("shaders/comp/a/one.glsl:1: error: 'nowhere'"));
    EXPECT_NE(build().status, 0) << "a failure is not forgotten";

    write("shaders/comp/a/one.glsl", "uint one() { return 3u; }\n");
    EXPECT_EQ(build().status, 0);
    EXPECT_THAT(build().said, HasSubstr("no work to do"));
}

TEST_F(BuildSlow, TwinIsGeneratedUnlessItIsWrittenByHand) {
    EXPECT_THAT(configure_with_twins().said, HasSubstr("build/generated/kernels/copy.cu\n"));
    const Outcome outcome = build();
    EXPECT_NE(outcome.status, 0);
    EXPECT_THAT(outcome.said,
                HasSubstr("shaders/comp/a/copy.comp:1: error: the kernel has no body"));

    write("shaders/cuda/a/copy.cu", "// by hand\n");
    EXPECT_THAT(configure_with_twins().said, HasSubstr("shaders/cuda/a/copy.cu\n"));
}

TEST_F(BuildSlow, TwinWithoutAKernelIsRefused) {
    write("shaders/cuda/a/gone.cu", "// its kernel was removed\n");
    Outcome outcome = configure_with_twins();
    EXPECT_NE(outcome.status, 0);
    EXPECT_THAT(outcome.said, HasSubstr("shaders/cuda/a/gone.cu"));

    fs::remove(root / "shaders/cuda/a/gone.cu");
    write("shaders/comp/a/gone_texels.comp", head + "void main() {}\n");
    outcome = configure_with_twins();
    EXPECT_NE(outcome.status, 0);
    EXPECT_THAT(outcome.said, HasSubstr("shares the twin of gone.comp"));
}

TEST_F(BuildSlow, TwoKernelsOfOneNameAreRefused) {
    write("shaders/comp/b/copy.comp", head + "void main() {}\n");
    const Outcome outcome = configure();
    EXPECT_NE(outcome.status, 0);
    EXPECT_THAT(outcome.said, HasSubstr("Two kernels are called copy"));
}

} // namespace
} // namespace argand::shader_compile
