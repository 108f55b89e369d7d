// Where the tool writes, and its errors when it cannot.
#include "argand_run.hpp"
#include "support/terminal.hpp"

#include <filesystem>

namespace argand::testing {
namespace {

using Outputs = ArgandTest;

TEST_F(Outputs, NothingThatIsReadOrWrittenIsReplaced) {
    write_text(file("scene.glb"), read_text(asset("cornell_point.glb")));
    std::filesystem::create_symlink("scene.glb", file("link.json"));
    std::filesystem::create_directory(file("folder"));
    const std::string render = "render scene.glb --size 4x4 --spp 1 ";
    for (const char* options :
         {"--json scene.glb", "--json ./folder/../scene.glb", "--json link.json",
          "-o a.png --json a.png", "-o a.png --json ./a.png", "-o a.png -o folder/../a.png",
          "-o a.exr -o b.png -o a.exr"}) {
        expect_failure(render + options, usage, "would replace");
    }
    expect_failure("render '" + file("scene.glb") + "' --json scene.glb", usage, "would replace");
    expect_failure("render scene.glb --json scene.png", usage,
                   "would replace"); // the picture's name by default
    EXPECT_TRUE(read_text(file("scene.glb")) == read_text(asset("cornell_point.glb")));

    ASSERT_EQ(argand(render + "-q -o a.exr -o b.exr --json report.json", on_host).exit_code, 0);
    const std::string before = pixels("b.exr");
    expect_failure("compare a.exr b.exr -o b.exr", usage, "would replace");
    expect_failure("compare a.exr b.exr -o ./a.exr", usage, "would replace");
    EXPECT_TRUE(pixels("b.exr") == before);
}

TEST_F(Outputs, ImagesAndBuffersOfTheSceneAreNotReplaced) {
    const std::string text = read_text(asset("plane_point.gltf"));
    const std::size_t at = text.find("\"asset\"");
    ASSERT_NE(at, std::string::npos);
    write_text(file("scene.gltf"),
               text.substr(0, at) + R"("images": [{"uri": "scene.png"}, {"uri": "a%20b.exr"}], )" +
                   text.substr(at));
    write_text(file("scene.png"), "a texture");
    write_text(file("a b.exr"), "another");
    const std::string render = "render scene.gltf --method path --size 4x4 --spp 1 ";
    expect_failure(render, usage, "would replace 'scene.png'"); // the picture's name by default
    for (const char* options :
         {"-o ./scene.png", "-o a.exr -o 'a b.exr'", "--json scene.png -o a.exr"}) {
        expect_failure(render + options, usage, "would replace");
    }
    // Whatever it is, it is no checkpoint.
    expect_failure(render + "--checkpoint scene.png -o a.exr", failure, "something else");
    EXPECT_EQ(read_text(file("scene.png")), "a texture");
    EXPECT_EQ(read_text(file("a b.exr")), "another");
    EXPECT_EQ(argand(render + "-q -o c.png", on_host).exit_code, 0);
}

TEST_F(Outputs, AKdTreeGivesTheSamePictures) {
    const std::string still =
        "render '" + asset("cornell_glass.glb") + "' --size 8x8 --spp 1 --photons 500 ";
    const auto expect_success = [&](const std::string& arguments) {
        const Outcome run = argand(arguments, on_host);
        EXPECT_EQ(run.exit_code, 0) << run.error;
        return run.error;
    };
    expect_success(still + "-q -o a.exr");
    expect_success(still + "-q -o b.exr --tracer kdtree --json b.json");
    EXPECT_TRUE(pixels("a.exr") == pixels("b.exr"));
    EXPECT_THAT(read_text(file("b.json")), ::testing::HasSubstr("build kd-tree"));
    EXPECT_THAT(expect_success(still + "-o c.exr --tracer kdtree --tree-memory 30000"),
                ::testing::HasSubstr("as more would exceed --tree-memory 30000"));
    EXPECT_TRUE(pixels("a.exr") == pixels("c.exr"));
    // Triangles that move.
    const std::string film = "render '" + asset("dynamic_water.glb") +
                             "' --size 8x8 --spp 1 --photons 500 --frames 0:2 -q ";
    expect_success(film + "-o a%d.exr");
    expect_success(film + "-o b%d.exr --tracer kdtree");
    EXPECT_TRUE(pixels("a1.exr") == pixels("b1.exr"));
}

TEST_F(Outputs, AFullStandardOutputIsNamed) {
    if (!std::filesystem::exists("/dev/full")) {
        GTEST_SKIP() << "there is no /dev/full here, the only output that is always full";
    }
    const std::string scene = "'" + asset("cornell_glass.glb") + "' ";
    for (const std::string& arguments :
         {"inspect --json " + scene, "inspect " + scene, std::string("devices"),
          std::string("render --help"),
          "render --size 4x4 --spp 1 --photons 0 -o a.png " + scene}) {
        const Outcome run = argand(arguments + " >/dev/full", on_host);
        EXPECT_EQ(run.exit_code, failure) << arguments;
        EXPECT_THAT(run.error, ::testing::StartsWith("argand: writing to the standard output: "))
            << arguments;
        EXPECT_EQ(std::count(run.error.begin(), run.error.end(), '\n'), 1) << run.error;
    }
    EXPECT_EQ(argand("render missing.glb 2>/dev/full").exit_code, failure);
    EXPECT_EQ(argand("paint 2>/dev/full").exit_code, usage);
}

TEST_F(Outputs, ValidationIsHeard) {
    // Argand does not enable best-practice validation, and does not follow all of its advice.
    const Outcome run = argand("render '" + asset("cornell_point.glb") +
                                   "' --size 4x4 --spp 1 --photons 0 -q -o a.png",
                               "VK_LAYER_ENABLES=VK_VALIDATION_FEATURE_ENABLE_BEST_PRACTICES_EXT");
    EXPECT_EQ(run.exit_code, failure);
    EXPECT_THAT(run.error, ::testing::StartsWith("argand: validation: "));
}

TEST_F(Outputs, TerminalsShowPassesRadiusAndErrorAndPipesNothing) {
    const Terminal terminal;
    ASSERT_GE(terminal.descriptor(), 0);
    const std::string render = "render '" + asset("cornell_point.glb") +
                               "' --method progressive --size 24x24 --spp 1 --photons 5000 "
                               "--passes 48 ";
    const Outcome shown = argand(render + "-o shown.exr 2>" + terminal.name(), on_host);
    ASSERT_EQ(shown.exit_code, 0);
    const std::string text = terminal.read();
    EXPECT_THAT(text, ::testing::ContainsRegex("pass [0-9]+, radius 0\\.[0-9]+"));
    EXPECT_THAT(text, ::testing::ContainsRegex("pass 4[0-9], radius 0\\.[0-9]+, error about "));
    const Outcome piped = argand(render + "-o piped.exr", on_host);
    ASSERT_EQ(piped.exit_code, 0);
    EXPECT_EQ(piped.error, "");
    EXPECT_EQ(pixels("shown.exr"), pixels("piped.exr"));
}

TEST_F(Outputs, ReportSaysNullOfWhatThereIsNot) {
    const std::string render =
        "render '" + asset("cornell_point.glb") + "' -q --size 4x4 --spp 1 --photons 100 -o a.png ";
    const Outcome run = argand(render + "--json a.json", "ARGAND_DISABLE=timestamps");
    ASSERT_EQ(run.exit_code, 0) << run.error;
    const nlohmann::json report = nlohmann::json::parse(read_text(file("a.json")));
    EXPECT_TRUE(report.at("parameters").at("bounces").is_null());
    ASSERT_FALSE(report.at("stages").empty());
    for (const nlohmann::json& stage : report.at("stages")) {
        EXPECT_TRUE(stage.at("gpu_seconds").is_null()) << stage;
        EXPECT_GT(stage.at("runs"), 0) << stage;
    }
    EXPECT_GT(report.at("wall_seconds").at("render"), 0);
}

} // namespace
} // namespace argand::testing
