// Groups: the buffers of NAME_bindings.glsl are one struct, which kernels that include it share.
#include "shader_compile/fixture.hpp"

namespace argand::shader_compile {
namespace {

using testing::HasSubstr;

struct Group : ShaderCompile {
    void SetUp() override {
        ShaderCompile::SetUp();
        write("shaders/comp/room_bindings.glsl",
              "layout(set = 0, binding = 0) readonly buffer Walls { uint walls[]; };\n"
              "layout(set = 0, binding = 1) buffer Floor { vec4 ground[]; };\n"
              "layout(constant_id = 8) const bool furnished = true;\n");
        write("shaders/comp/a/enter.comp",
              head +
                  "#include \"room_bindings.glsl\"\n"
                  "layout(set = 0, binding = 2) buffer Guests { uint guests[]; };\n"
                  "layout(constant_id = 0) const uint most = 3;\n"
                  "void main() { guests[0] = furnished ? walls[0] : most; ground[0].x = 1.0; }\n");
        ASSERT_EQ(compile("shaders/comp/room_bindings.glsl").said, "");
        depfile = generated("depfile.d");
        ASSERT_EQ(compile("shaders/comp/a/enter.comp").said, "");
    }
    std::string depfile;
    const std::string before = "#include \"kernels/enter.hpp\"\n"
                               "using namespace argand;\n"
                               "KernelArguments f(const Buffer& a, const Buffer& b) {\n"
                               "    const kernels::RoomBindings room";
};

TEST_F(Group, IsAStructOfItsOwn) {
    const std::string header = generated("room_bindings.hpp");
    EXPECT_THAT(header, HasSubstr("struct RoomBindings {"));
    EXPECT_THAT(header, HasSubstr("struct RoomConstants {\n    bool furnished = true;\n};"));
    EXPECT_FALSE(is_generated("room_bindings.cpp"));
    EXPECT_THAT(depfile, testing::StartsWith("out/kernels/room_bindings.hpp: "));
    EXPECT_THAT(depfile, HasSubstr("shaders/comp/room_bindings.glsl"));
    EXPECT_THAT(depfile, testing::Not(HasSubstr(".comp")));
}

TEST_F(Group, IsOneMemberOfAKernel) {
    EXPECT_THAT(generated("enter.hpp"), HasSubstr("    RoomBindings room; "));
    EXPECT_THAT(generated("enter.hpp"), HasSubstr("        RoomConstants room = {};"));
    const Outcome source = check_cpp_file("out/kernels/enter.cpp");
    EXPECT_EQ(source.status, 0) << source.said;
    const Outcome use =
        check_cpp(before + "{.walls = a, .ground = b};\n"
                           "    return kernels::enter{.room = room, .guests = a,\n"
                           "        .constants = {.most = 1, .room = {.furnished = false}}}"
                           ".arguments();\n}\n");
    EXPECT_EQ(use.status, 0) << use.said;
}

TEST_F(Group, ThatLacksABufferDoesNotCompile) {
    const Outcome outcome = check_cpp(
        before + "{.walls = a};\n"
                 "    return kernels::enter{.room = room, .guests = b}.arguments();\n}\n");
    EXPECT_NE(outcome.status, 0);
    EXPECT_THAT(outcome.said, HasSubstr("ground"));
}

TEST_F(Group, KernelThatLacksItDoesNotCompile) {
    const Outcome outcome =
        check_cpp(before + "{.walls = a, .ground = b};\n    (void)room;\n"
                           "    return kernels::enter{.guests = b}.arguments();\n}\n");
    EXPECT_NE(outcome.status, 0);
    EXPECT_THAT(outcome.said, HasSubstr("room"));
}

TEST_F(Group, DeclaresTheSameInEveryKernel) {
    write("shaders/comp/room_bindings.glsl",
          "layout(set = 0, binding = 0) readonly buffer Walls { uint walls[]; };\n"
          "#ifndef OUTDOORS\n"
          "layout(set = 0, binding = 1) buffer Floor { vec4 ground[]; };\n"
          "#endif\n");
    write("shaders/comp/a/leave.comp",
          head + "#define OUTDOORS\n#include \"room_bindings.glsl\"\nvoid main() {}\n");
    ASSERT_EQ(compile("shaders/comp/room_bindings.glsl").said, "");
    ASSERT_EQ(compile("shaders/comp/a/leave.comp").said, "");
    EXPECT_THAT(check_cpp_file("out/kernels/leave.cpp").said,
                HasSubstr("room_bindings.glsl declares other buffers here"));
}

} // namespace
} // namespace argand::shader_compile
