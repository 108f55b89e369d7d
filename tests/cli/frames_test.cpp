// Films: argand render --frames.
#include "argand_run.hpp"

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
    bool same(const std::string& a, const std::string& b) const {
        return read_text(file(a)) == read_text(file(b));
    }
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
    // Each report counts its own frame, not those before.
    EXPECT_EQ(reports[1]["stages"][0]["runs"], reports[2]["stages"][0]["runs"]);
    EXPECT_EQ(reports[1]["wall_seconds"]["load"], 0);
}

TEST_F(Frames, MayHaveNoiseOfTheirOwn) {
    ASSERT_EQ(argand(film("--frames 7:8 --seed-per-frame --seed 4 -o f%d.exr"), on_host).exit_code,
              0);
    ASSERT_EQ(argand(film("--at 0.2916666666666667 --seed 11 -o at.exr"), on_host).exit_code, 0);
    EXPECT_TRUE(same("f7.exr", "at.exr"));
}

TEST_F(Frames, GoOnWhereTheyStopped) {
    ASSERT_EQ(argand(film("--frames 0:4 -o f%d.exr --json f.json"), on_host).exit_code, 0);
    const std::string whole = read_text(file("f2.exr"));
    std::filesystem::remove(file("f2.exr"));
    write_text(file("f0.exr"), "not a picture");
    ASSERT_EQ(argand(film("--frames 0:5 -o f%d.exr --json f.json --continue"), on_host).exit_code,
              0);
    EXPECT_TRUE(read_text(file("f2.exr")) == whole);
    EXPECT_EQ(read_text(file("f0.exr")), "not a picture"); // existing frames are left alone
    const std::vector<nlohmann::json> reports = lines("f.json");
    ASSERT_EQ(reports.size(), 6u);
    EXPECT_EQ(reports[4]["frame"], 2);
    EXPECT_EQ(reports[5]["frame"], 4);
}

TEST_F(Frames, InterruptedOnesLeaveWholeFrames) {
    // A shell without job control ignores SIGINT, and so do its children: hence SIGTERM.
    const std::string command =
        "--version >/dev/null; exec timeout -s TERM 4 '" ARGAND_EXECUTABLE "' render '" +
        asset("moving_light.glb") +
        "' --backend cpu --size 32x32 --spp 4 --photons 5000 -q --frames 0:100000 -o f%04d.exr";
    const Outcome run = argand(command + " 2>'" + file("error") + "'");
    const std::string error = read_text(file("error"));
    std::filesystem::remove(file("error"));
    EXPECT_EQ(run.exit_code, 124); // timeout's own
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
    for (const char* range : {"3:3", "4:2", "4", ":", "a:b", "-1:2", "0:1e3", "0:99999999"}) {
        expect_usage(std::string("--frames ") + range, "write A:B");
    }
    for (const char* name : {"f.png", "f_%d_%d.png", "f%5d.png", "f%s.png", "f%.png", "f%%d.png",
                             "f%099999999999999999999999d.png"}) {
        expect_usage(std::string("--frames 0:2 -o ") + name, "one place for the frame's number");
    }
    expect_usage("--frames 0:2 --at 1", "leave one of the two out");
    expect_usage("--fps 12", "it needs --frames");
    expect_usage("--continue", "it needs --frames");
    expect_usage("--seed-per-frame", "it needs --frames");
    expect_usage("--frames 0:2 --fps 0", "--fps");
    expect_usage("--frames 0:2 -o f%d.jpg", "f%d.jpg");
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

} // namespace
} // namespace argand::testing
