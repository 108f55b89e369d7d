// Films: argand render --frames.
#include "argand_run.hpp"
#include "methods/method_info.hpp"

#include <filesystem>
#include <fstream>

namespace argand::testing {
namespace {

class Frames : public ArgandTest {
protected:
    static std::string film(const std::string& options) {
        return "render '" + asset("moving_light.glb") + "' --size 8x8 --spp 1 --photons 500 -q " +
               options;
    }
    std::vector<nlohmann::json> lines(const std::string& name) const {
        std::ifstream in(file(name));
        std::vector<nlohmann::json> reports;
        for (std::string line; std::getline(in, line);) {
            reports.push_back(nlohmann::json::parse(line));
        }
        return reports;
    }
    bool same(const std::string& a, const std::string& b) const { return pixels(a) == pixels(b); }
};

TEST_F(Frames, AreThePicturesOfTheirTimes) {
    ASSERT_EQ(argand(film("--frames 3:6 --fps 4 -o f_%03d.exr -o f%d.png --json f.json"), on_host)
                  .exit_code,
              0);
    EXPECT_EQ(files(), (std::vector<std::string>{"f.json", "f3.png", "f4.png", "f5.png",
                                                 "f_003.exr", "f_004.exr", "f_005.exr"}));
    for (const char* name : {"f_003.exr", "f_004.exr", "f_005.exr"}) {
        const int frame = name[4] - '0';
        ASSERT_EQ(argand(film("-o at.exr --at " + std::to_string(frame * 0.25)), on_host).exit_code,
                  0);
        EXPECT_TRUE(same(name, "at.exr")) << name;
    }
    EXPECT_FALSE(same("f_003.exr", "f_004.exr"));
    const std::vector<nlohmann::json> reports = lines("f.json");
    ASSERT_EQ(reports.size(), 3u);
    for (std::size_t i = 0; i < 3; ++i) {
        EXPECT_EQ(reports[i]["frame"], i + 3);
        EXPECT_EQ(reports[i]["parameters"]["at"], (double(i) + 3) / 4);
        EXPECT_EQ(reports[i]["outputs"].size(), 2u);
        EXPECT_EQ(reports[i]["parameters"]["seed"], 0);
    }
    // Stages count their own frame, not those before.
    EXPECT_EQ(reports[1]["stages"][0]["runs"], reports[2]["stages"][0]["runs"]);
    for (const char* once : {"load", "open_device", "upload"}) {
        EXPECT_GT(reports[0]["wall_seconds"][once], 0) << once;
        EXPECT_EQ(reports[1]["wall_seconds"][once], 0) << once;
    }
    EXPECT_TRUE(reports[1]["wall_seconds"]["load_steps"].empty());
}

TEST_F(Frames, HaveTheBitsOfTheirTimesWhateverTheyKeep) {
    for (const std::string& method : method_names()) {
        SCOPED_TRACE(method);
        const MethodInfo& info = builtin_methods().at(method);
        const std::string render = "render '" + asset("moving_light.glb") +
                                   "' --size 8x8 --spp 1 -q --method " + method +
                                   (info.option("photons") ? " --photons 500" : "");
        const std::string frames = render + " --frames 5:8 ";
        ASSERT_EQ(argand(render + " --at 0.2916666666666667 -o at.exr", on_host).exit_code, 0);
        ASSERT_EQ(argand(frames + "-o none%d.exr --keep none", on_host).exit_code, 0);
        EXPECT_TRUE(same("none7.exr", "at.exr"));
        ASSERT_EQ(argand(frames + "-o all%d.exr", on_host).exit_code, 0);
        EXPECT_EQ(same("all7.exr", "at.exr"), !info.abilities.keeps_photons);
    }
}

TEST_F(Frames, AreNotRenderedAgainWhereNothingHasChanged) {
    const std::string options = "render '" + asset("cornell_point.glb") +
                                "' --size 8x8 --spp 1 --photons 500 -q --frames 0:3 ";
    ASSERT_EQ(argand(options + "-o f%d.exr --json f.json", on_host).exit_code, 0);
    EXPECT_TRUE(same("f0.exr", "f1.exr"));
    EXPECT_TRUE(same("f0.exr", "f2.exr"));
    const std::vector<nlohmann::json> reports = lines("f.json");
    ASSERT_EQ(reports.size(), 3u);
    const auto runs = [&](std::size_t frame) {
        int all = 0;
        for (const nlohmann::json& stage : reports[frame]["stages"]) {
            all += stage["runs"].get<int>();
        }
        return all;
    };
    EXPECT_GT(runs(0), 10);
    EXPECT_LE(runs(2), 1); // the look whether anything has moved
    EXPECT_EQ(reports[2]["photons_emitted"], 500);
    ASSERT_EQ(argand(options + "-o s%d.exr --seed-per-frame", on_host).exit_code, 0);
    EXPECT_FALSE(same("s0.exr", "s1.exr"));
}

TEST_F(Frames, SeeWhatHappensWhileTheirShutterIsOpen) {
    const std::string options = "render '" + asset("moving_light.glb") +
                                "' --size 8x8 --spp 4 --photons 500 -q --frames 2:4 --fps 2 ";
    ASSERT_EQ(argand(options + "-o s%d.exr", on_host).exit_code, 0);
    ASSERT_EQ(argand(options + "--shutter 0:1 -o b%d.exr --json b.json", on_host).exit_code, 0);
    EXPECT_FALSE(same("s2.exr", "b2.exr"));
    EXPECT_FALSE(same("b3.exr", "b2.exr"));
    const std::vector<nlohmann::json> reports = lines("b.json");
    ASSERT_EQ(reports.size(), 2u);
    EXPECT_EQ(reports[1]["parameters"]["at"], 1.5);
    EXPECT_EQ(reports[1]["parameters"]["shutter"], nlohmann::json({1.5, 2.0}));
    EXPECT_EQ(reports[1]["passes"], 4);
    EXPECT_EQ(reports[1]["samples_per_pixel"], 4);
    EXPECT_EQ(reports[1]["photons_emitted"], 500);
    // Frame 2 with the shutter from one frame later on sees what frame 3 does.
    ASSERT_EQ(argand(options + "--shutter 1:2 -o l%d.exr", on_host).exit_code, 0);
    EXPECT_TRUE(same("l2.exr", "b3.exr"));
}

TEST_F(Frames, MayHaveNoiseOfTheirOwn) {
    ASSERT_EQ(argand(film("--frames 7:8 --seed-per-frame --seed 4 -o f%d.exr"), on_host).exit_code,
              0);
    ASSERT_EQ(argand(film("--at 0.2916666666666667 --seed 11 -o at.exr"), on_host).exit_code, 0);
    EXPECT_TRUE(same("f7.exr", "at.exr"));
}

TEST_F(Frames, GoOnWhereTheyStopped) {
    ASSERT_EQ(argand(film("--frames 0:4 -o f%d.exr --json f.json"), on_host).exit_code, 0);
    const std::string whole = pixels("f2.exr");
    const std::string first = pixels("f0.exr");
    std::filesystem::remove(file("f2.exr"));
    write_text(file("f0.exr"), "");
    const std::string left = read_text(file("f1.exr"));
    std::filesystem::resize_file(file("f3.exr"), std::filesystem::file_size(file("f3.exr")) / 2);
    ASSERT_EQ(argand(film("--frames 0:5 -o f%d.exr --json f.json --continue"), on_host).exit_code,
              0);
    EXPECT_TRUE(pixels("f2.exr") == whole);
    EXPECT_TRUE(pixels("f0.exr") == first);
    EXPECT_TRUE(read_text(file("f1.exr")) == left);
    const std::vector<nlohmann::json> reports = lines("f.json");
    ASSERT_EQ(reports.size(), 8u);
    for (const auto& [line, frame] : {std::pair{4, 0}, {5, 2}, {6, 3}, {7, 4}}) {
        EXPECT_EQ(reports[line]["frame"], frame);
    }
    EXPECT_EQ(reports[7]["tree_cost"], 1); // no object moves
    EXPECT_EQ(reports[7]["parameters"]["fps"], 24);
    EXPECT_EQ(reports[7]["parameters"]["keep"], "all");
    EXPECT_EQ(reports[7]["parameters"]["seed_per_frame"], false);
    expect_failure("render '" + asset("moving_light.glb") +
                       "' --size 8x9 -q --frames 0:5 -o f%d.exr --continue",
                   failure, "continuing 'f0.exr': it has 8 × 8 pixels, and not 8 × 9", on_host);
}

TEST_F(Frames, AddReportsToWholeLinesOnly) {
    const std::string options = "-o f%d.exr --json f.json --continue --frames ";
    ASSERT_EQ(argand(film(options + "0:2"), on_host).exit_code, 0);
    std::ofstream(file("f.json"), std::ios::app) << "{\"frame\": 2, \"sce";
    ASSERT_EQ(argand(film(options + "0:3"), on_host).exit_code, 0);
    ASSERT_EQ(lines("f.json").size(), 3u);
    EXPECT_EQ(lines("f.json")[2]["frame"], 2);
    // All frames are there: nothing is said of them.
    std::filesystem::remove(file("f.json"));
    ASSERT_EQ(argand(film(options + "0:3"), on_host).exit_code, 0);
    EXPECT_FALSE(std::filesystem::exists(file("f.json")));
    write_text(file("f.json"), "{\"frame\": 0}\nnotes\n");
    expect_failure(film(options + "0:4"), failure,
                   "continuing 'f.json': line 2 is no report of a frame", on_host);
    EXPECT_EQ(read_text(file("f.json")), "{\"frame\": 0}\nnotes\n");
}

TEST_F(Frames, FollowObjectsThatMove) {
    nlohmann::json scene = nlohmann::json::parse(read_text(asset("plane_point.gltf")));
    // The plane, which is node 0, rises from y = 0 to 0.8 m in two seconds.
    const std::vector<float> keys{0, 2, 0, 0, 0, 0, 0.8f, 0};
    write_text(file("keys.bin"), std::string(reinterpret_cast<const char*>(keys.data()), 32));
    const auto append = [&](const char* list, const nlohmann::json& element) {
        scene[list].push_back(element);
        return scene[list].size() - 1;
    };
    const std::size_t buffer = append("buffers", {{"byteLength", 32}, {"uri", "keys.bin"}});
    const std::size_t view = append("bufferViews", {{"buffer", buffer}, {"byteLength", 32}});
    const auto accessor = [&](const char* type, int offset) {
        return append("accessors", {{"bufferView", view},
                                    {"byteOffset", offset},
                                    {"componentType", 5126},
                                    {"type", type},
                                    {"count", 2}});
    };
    const std::size_t input = accessor("SCALAR", 0), output = accessor("VEC3", 8);
    scene["animations"] = {
        {{"samplers", {{{"input", input}, {"output", output}}}},
         {"channels", {{{"sampler", 0}, {"target", {{"node", 0}, {"path", "translation"}}}}}}}};
    write_text(file("rising.gltf"), scene.dump());
    const std::string render = "render rising.gltf --size 8x8 --spp 1 --photons 500 -q ";
    ASSERT_EQ(argand(render + "--frames 0:3 --fps 1 -o f%d.exr", on_host).exit_code, 0);
    for (const char* second : {"0", "1", "2"}) {
        ASSERT_EQ(argand(render + "-o at.exr --at " + second, on_host).exit_code, 0);
        EXPECT_TRUE(same(std::string("f") + second + ".exr", "at.exr")) << second;
    }
    EXPECT_FALSE(same("f0.exr", "f1.exr"));
}

TEST_F(Frames, InterruptedOnesLeaveWholeFrames) {
    // Ends the film once it has a frame. (A shell without job control ignores SIGINT, and so do its
    // children: hence SIGTERM.)
    const std::string command =
        "--version >/dev/null; '" ARGAND_EXECUTABLE "' render '" + asset("moving_light.glb") +
        "' --backend cpu --size 32x32 --spp 4 --photons 5000 -q --frames 0:100000 -o f%06d.exr "
        "2>error & film=$!; while kill -0 $film && ! test -e f000000.exr; do sleep 0.05; done; "
        "kill -TERM $film; wait $film";
    const Outcome run = argand(command);
    const std::string error = read_text(file("error"));
    std::filesystem::remove(file("error"));
    EXPECT_EQ(run.exit_code, failure);
    const std::vector<std::string> names = files();
    ASSERT_FALSE(names.empty());
    EXPECT_THAT(error, ::testing::HasSubstr("interrupted in frame " + std::to_string(names.size()) +
                                            ", which is not"));
    // All that are there are complete, and nothing else is there.
    EXPECT_EQ(argand("compare " + names.front() + " " + names.back()).exit_code, 0);
}

TEST_F(Frames, WrongOptionsAreUsageErrors) {
    const auto expect_usage = [&](const std::string& options, const char* text) {
        expect_failure("render '" + asset("moving_light.glb") + "' " + options, usage, text);
    };
    for (const char* range : {"''", "3:3", "4:2", "4", ":", "a:b", "-1:2", "0:1e3", "0:99999999"}) {
        expect_usage(std::string("--frames ") + range, "write A:B");
    }
    for (const char* name : {"f.png", "f_%d_%d.png", "f%5d.png", "f%s.png", "f%.png", "f%%d.png",
                             "f%099999999999999999999999d.png"}) {
        expect_usage(std::string("--frames 0:2 -o ") + name, "one place for the frame's number");
    }
    expect_usage("--frames 0:2 --at 1", "leave one of the two out");
    expect_usage("--fps 12", "it needs --frames");
    expect_usage("--continue", "it needs --frames");
    expect_usage("--keep none", "it needs --frames");
    expect_usage("--shutter 0:1", "it needs --frames");
    for (const char* shutter : {"1", "0:0", "0.5:0", "0:nan", "0:inf", "a:b", "0:1:2", ":"}) {
        expect_usage(std::string("--frames 0:2 --shutter '") + shutter + "'", "--shutter");
    }
    expect_usage("--frames 0:2 --shutter 0:1 --target-error 0.1", "--target-error");
    expect_usage("--frames 0:2 --keep some", "--keep");
    expect_usage("--seed-per-frame", "it needs --frames");
    expect_usage("--frames 0:2 --fps 0", "--fps");
    expect_usage("--frames 0:2 -o f%d.jpg", "f0.jpg");
}

TEST_F(Frames, AFullDiskStopsThem) {
    if (!std::filesystem::exists("/dev/full")) {
        GTEST_SKIP() << "there is no /dev/full here, the only file that is always full";
    }
    const Outcome run = argand(film("--frames 0:9 -o f%d.exr --json /dev/full"), on_host);
    EXPECT_EQ(run.exit_code, failure);
    EXPECT_THAT(run.error, ::testing::HasSubstr("writing '/dev/full': the disk is full"));
    EXPECT_EQ(files(), std::vector<std::string>{"f0.exr"});
}

TEST_F(Frames, AFullDiskLeavesWholeReports) {
    // Files may have 16 KiB: a line has some thousand bytes, a picture less.
    const Outcome run = argand("--version >/dev/null; trap '' XFSZ; ulimit -f 32; "
                               "'" ARGAND_EXECUTABLE "' " +
                               film("--frames 0:20 -o f%d.exr --json f.json 2>error"));
    EXPECT_EQ(run.exit_code, failure);
    EXPECT_THAT(read_text(file("error")), ::testing::HasSubstr("writing 'f.json': the disk is"));
    const std::size_t written = lines("f.json").size(); // which parses them
    EXPECT_GT(written, 0u);
    EXPECT_EQ(files().size(), written + 3); // the picture of the next one, f.json and error
}

} // namespace
} // namespace argand::testing
