#include "argand_run.hpp"

#include <filesystem>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace argand::testing {
namespace {

using ::testing::HasSubstr;
using Tradeoff = ArgandTest;

TEST_F(Tradeoff, MeasuresAndResumes) {
    const std::string on_scene =
        fmt::format("tradeoff '{}' -o sweep --size 12x12 --quick --methods path --backend cpu",
                    asset("cornell_area.glb"));
    const std::string command = on_scene + " --seeds 2 --reference-seconds 0";
    const Outcome first = argand(command);
    ASSERT_EQ(first.exit_code, 0) << first.error;
    EXPECT_THAT(first.out, HasSubstr("sweep/tradeoff.html"));
    const std::string csv = read_text(file("sweep/tradeoff.csv"));
    EXPECT_THAT(csv, HasSubstr("path,spp,32,"));
    // The times would differ if anything were measured again.
    const Outcome second = argand(command);
    EXPECT_EQ(second.out, first.out);
    EXPECT_EQ(read_text(file("sweep/tradeoff.csv")), csv);
    expect_failure(on_scene + " --seeds 3", 1,
                   "another seeds (2, now 3); remove the folder, or choose another with -o");
    const Outcome patient = argand(on_scene + " --seeds 2 --reference-seconds 7");
    EXPECT_EQ(patient.out, first.out) << patient.error;
    std::filesystem::remove(file("sweep/reference.exr"));
    EXPECT_EQ(argand(command).exit_code, 0);
    EXPECT_EQ(read_text(file("sweep/tradeoff.csv")), csv);
    // A sweep that another build of the program began is not resumed.
    nlohmann::ordered_json kept =
        nlohmann::ordered_json::parse(read_text(file("sweep/tradeoff.json")));
    kept.at("run").at("build") = "another";
    write_text(file("sweep/tradeoff.json"), kept.dump());
    expect_failure(command, 1, "another build (another, now ");
    // `compare` uses the two halves of the reference to remove its noise.
    const Outcome compared =
        argand("compare sweep/pictures/path-spp-2.exr sweep/reference.exr --json");
    ASSERT_EQ(compared.exit_code, 0) << compared.error;
    const nlohmann::json metrics = nlohmann::json::parse(compared.out);
    EXPECT_TRUE(metrics.at("relMSE_without_reference_noise").is_number());
    EXPECT_NE(metrics.at("relMSE_without_reference_noise"), metrics.at("relMSE"));
}

TEST_F(Tradeoff, DrawsSettingsAsAccurateAsTheReference) {
    nlohmann::json scene = nlohmann::json::parse(read_text(asset("plane_point.gltf")));
    for (nlohmann::json& node : scene.at("nodes")) {
        node.erase("extensions");
    }
    write_text(file("unlit.gltf"),
               scene.dump()); // under a white sky: the radiance is uniform
    const Outcome swept =
        argand("tradeoff unlit.gltf --env 1,1,1 --size 16x16 --quick --methods path,path --seeds 2 "
               "--reference-seconds 0 --backend cpu");
    ASSERT_EQ(swept.exit_code, 0) << swept.error;
    EXPECT_THAT(swept.out, HasSubstr("4 settings measured"));
    const std::string page = read_text(file("unlit.tradeoff/tradeoff.html"));
    const auto count = [&](const std::string& text) {
        std::size_t found = 0;
        for (std::size_t at = page.find(text); at != std::string::npos;
             at = page.find(text, at + 1)) {
            ++found;
        }
        return found;
    };
    EXPECT_EQ(count("<circle"), 4 + 1u) << "and the legend's";
    EXPECT_GE(count("<tr class=\"front\">"), 1u);
    EXPECT_EQ(count("below: within the reference's noise"), 1u);
}

TEST_F(Tradeoff, Replots) {
    const std::string on_scene = fmt::format("tradeoff '{}' ", asset("cornell_area.glb"));
    write_text(file("old.csv"),
               "method,knob,value,wall_seconds,device_seconds,peak_bytes,relMSE,relMSE_deviation,"
               "SSIM,SSIM_deviation,squared_bias,variance,seeds,on_front,options\n"
               "path,spp,4,1.5,,1000,0.01,0.001,0.9,0,,,2,1,--method path --spp 4\n");
    const Outcome plotted = argand(on_scene + "--replot old.csv");
    ASSERT_EQ(plotted.exit_code, 0) << plotted.error;
    EXPECT_EQ(plotted.out, "old.svg: 1 settings plotted\n");
    const std::string svg = read_text(file("old.svg"));
    EXPECT_THAT(svg, HasSubstr("cornell_area.glb: error against time"));
    EXPECT_THAT(svg, HasSubstr("--method path --spp 4</title>"));
    write_text(file("bad.csv"), "a,b\n1,2\n");
    expect_failure(on_scene + "--replot bad.csv", 1, "bad.csv': it is not a table");
    expect_failure(on_scene + "--replot missing.csv", 1, "missing.csv");
}

TEST_F(Tradeoff, BadInput) {
    const std::string scene = fmt::format("tradeoff '{}' ", asset("cornell_area.glb"));
    expect_failure("tradeoff", 2, "scene");
    expect_failure("tradeoff missing.glb", 1, "missing.glb");
    expect_failure(scene + "--size 8", 2, "--size");
    expect_failure(scene + "--seeds 0", 2, "--seeds");
    expect_failure(scene + "--methods rays", 2, "rays");
    expect_failure(scene + "--reference-seconds -1", 2, "--reference-seconds");
    expect_failure(scene + "--reference missing.exr", 1, "missing.exr");
    expect_failure(scene + "--reference-2 missing.exr", 2, "--reference");
    write_text(file("file"), "");
    expect_failure(scene + "-o file", 1, "'file");
    write_text(file("tradeoff.json"), "[]");
    expect_failure(scene + "-o .", 1, "tradeoff.json");
}

TEST_F(Tradeoff, ReferenceOfAnotherSize) {
    const Outcome rendered = argand(
        fmt::format("render '{}' --method path --spp 1 --size 8x8 -o reference.exr --backend cpu",
                    asset("cornell_area.glb")));
    ASSERT_EQ(rendered.exit_code, 0) << rendered.error;
    expect_failure(fmt::format("tradeoff '{}' --reference reference.exr --backend cpu",
                               asset("cornell_area.glb")),
                   1, "--size 8x8");
}

} // namespace
} // namespace argand::testing
