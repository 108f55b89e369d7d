// Renders that are saved, killed and resumed.
#include "argand_run.hpp"

#include <filesystem>
#include <fstream>
#include <sys/stat.h>

namespace argand::testing {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

class Checkpoints : public ArgandTest {
protected:
    static std::string render(const std::string& options, const std::string& quiet = "-q ") {
        return "render '" + asset("cornell_glass.glb") + "' --size 12x12 --spp 4 " + quiet +
               options;
    }
    /// Eight passes.
    static constexpr const char* long_render = "--method photons --photons 2000000 ";
    Outcome run(const std::string& options) { return argand(render(options), on_host); }
    void expect_error(const std::string& options, const std::string& text, int status = failure) {
        expect_failure(render(options), status, text, on_host);
    }
    /// Runs the tool until a signal ends it, or it ends by itself.
    void run_for(double seconds, const std::string& signal, const std::string& options) {
        const std::string command =
            fmt::format("cd '{}' && {} OMP_WAIT_POLICY=passive timeout -s {} {} '{}' {} "
                        ">/dev/null 2>&1",
                        file("."), on_host, signal, seconds, ARGAND_EXECUTABLE, render(options));
        EXPECT_NE(std::system(command.c_str()), -1);
    }
    /// Runs the tool, and interrupts it once this file is there. Returns its exit status. A second
    /// signal would end the tool at once: `timeout` sends one to its process group, too, unless it
    /// is in the foreground. (Shells ignore SIGINT in their children: hence SIGTERM.)
    std::string status_if_interrupted_at(const std::string& name, const std::string& options) {
        const std::string command =
            fmt::format("cd '{}' && {{ {} OMP_WAIT_POLICY=passive timeout --foreground 300 '{}' {} "
                        "2>error & "
                        "render=$!; while kill -0 $render && ! test -e {}; do sleep 0.05; done; "
                        "kill -TERM $render; wait $render; echo $? >status; }} >/dev/null 2>&1",
                        file("."), on_host, ARGAND_EXECUTABLE, render(options, ""), name);
        EXPECT_NE(std::system(command.c_str()), -1);
        return read_text(file("status"));
    }
    /// Expects the picture of a whole render from one that is interrupted and resumed.
    void expect_same_picture_if_interrupted(const std::string& options) {
        ASSERT_EQ(run(options + "-o whole.exr").exit_code, 0);
        ASSERT_EQ(status_if_interrupted_at("c", options + "-o part.exr --checkpoint c --every 0"),
                  "0\n")
            << read_text(file("error"));
        EXPECT_THAT(read_text(file("error")), HasSubstr("--resume c goes on with it"));
        EXPECT_NE(pixels("whole.exr"), pixels("part.exr"));
        ASSERT_EQ(run(options + "-o resumed.exr --resume c").exit_code, 0);
        EXPECT_EQ(pixels("whole.exr"), pixels("resumed.exr"));
    }
    void truncate(const std::string& name) {
        std::filesystem::resize_file(file(name), std::filesystem::file_size(file(name)) / 2);
    }
};

TEST_F(Checkpoints, OfACompleteRenderGiveItsPictureAgain) {
    ASSERT_EQ(run("-o whole.exr").exit_code, 0);
    ASSERT_EQ(run("-o saved.exr --checkpoint c").exit_code, 0);
    ASSERT_EQ(run("-o again.exr --resume c").exit_code, 0);
    EXPECT_EQ(pixels("whole.exr"), pixels("saved.exr"));
    EXPECT_EQ(pixels("whole.exr"), pixels("again.exr"));
    EXPECT_EQ(files(), (std::vector<std::string>{"again.exr", "c", "saved.exr", "whole.exr"}));
}

TEST_F(Checkpoints, SlowGoOnAfterAKillAtAnyMoment) {
    const std::string passes = long_render;
    ASSERT_EQ(run(passes + "-o whole.exr").exit_code, 0);
    for (const double seconds : {0.2, 0.4, 0.6}) {
        const std::string resume = std::filesystem::exists(file("c")) ? " --resume c" : "";
        run_for(seconds, "KILL", passes + "-o killed.exr --checkpoint c --every 0" + resume);
    }
    if (!std::filesystem::exists(file("c"))) {
        ASSERT_EQ(run(passes + "-o no.exr --checkpoint c --every 0").exit_code, 0);
    }
    ASSERT_EQ(run(passes + "-o resumed.exr --resume c").exit_code, 0);
    EXPECT_EQ(pixels("whole.exr"), pixels("resumed.exr"));
}

TEST_F(Checkpoints, OfAProgressiveRenderTakeMorePasses) {
    const std::string progressive = "--method progressive --photons 2000 --r1 0.3 ";
    ASSERT_EQ(run(progressive + "--passes 5 -o whole.exr").exit_code, 0);
    ASSERT_EQ(run(progressive + "--passes 2 -o two.exr --checkpoint c --every 0").exit_code, 0);
    ASSERT_EQ(run(progressive + "--passes 5 -o five.exr --resume c").exit_code, 0);
    EXPECT_EQ(pixels("whole.exr"), pixels("five.exr"));
    EXPECT_NE(pixels("whole.exr"), pixels("two.exr"));
    // Fewer passes than there are cannot be had again.
    const Outcome fewer =
        argand("render '" + asset("cornell_glass.glb") + "' --size 12x12 --spp 4 " + progressive +
                   "--passes 4 -o fewer.exr --checkpoint c --resume c",
               on_host);
    ASSERT_EQ(fewer.exit_code, 0) << fewer.error;
    EXPECT_EQ(fewer.error, "");
    const Outcome fewest =
        argand("render '" + asset("cornell_glass.glb") + "' --size 12x12 --spp 4 " + progressive +
                   "--passes 3 -o fewest.exr --resume c",
               on_host);
    ASSERT_EQ(fewest.exit_code, 0) << fewest.error;
    EXPECT_EQ(fewest.error, "argand: note: 'c' holds 4 passes, more than --passes asks for; the "
                            "picture has all of them\n");
    EXPECT_EQ(pixels("fewer.exr"), pixels("fewest.exr"));
    expect_error(progressive + "--passes 5 --radius-exponent 0.2 -o no.exr --resume c",
                 "--radius-exponent");
}

TEST_F(Checkpoints, AreNotNeededForPicturesOnTheWay) {
    EXPECT_EQ(status_if_interrupted_at("part.exr", "--method progressive --photons 2000 --passes "
                                                   "1000000 -o part.exr --every 0"),
              "0\n")
        << read_text(file("error"));
    EXPECT_GT(pixels("part.exr").size(), 0u);
}

TEST_F(Checkpoints, OfAnInterruptedProgressiveRenderAreGoneOnFrom) {
    expect_same_picture_if_interrupted("--method progressive --photons 2000 --passes 100 ");
}

TEST_F(Checkpoints, AreReplacedByTheOlderOneWhereTheyAreDamaged) {
    ASSERT_EQ(run(std::string(long_render) + "-o whole.exr --checkpoint c --every 0").exit_code, 0);
    ASSERT_TRUE(std::filesystem::exists(file("c.old")));
    truncate("c");
    const std::string older = read_text(file("c.old"));
    Outcome outcome = argand("render '" + asset("cornell_glass.glb") + "' --size 12x12 --spp 4 " +
                                 std::string(long_render) + "-o resumed.exr --resume c",
                             on_host);
    ASSERT_EQ(outcome.exit_code, 0) << outcome.error;
    EXPECT_THAT(outcome.error, AllOf(HasSubstr("bytes"), HasSubstr("going on from the checkpoint "
                                                                   "before it, 'c.old'")));
    EXPECT_EQ(pixels("whole.exr"), pixels("resumed.exr"));
    EXPECT_EQ(read_text(file("c.old")), older);
    std::filesystem::remove(file("c"));
    EXPECT_EQ(run(std::string(long_render) + "-o resumed.exr --resume c").exit_code, 0);
    // One byte is wrong.
    std::fstream(file("c.old"), std::ios::in | std::ios::out | std::ios::binary)
        .seekp(500)
        .put(older[500] == 'x' ? 'y' : 'x');
    expect_error(std::string(long_render) + "-o no.exr --resume c.old", "it is damaged");
}

TEST_F(Checkpoints, FollowLinksAndReplaceDamagedOnes) {
    ASSERT_EQ(run(std::string(long_render) + "-o whole.exr --checkpoint c --every 0").exit_code, 0);
    std::filesystem::create_directory(file("far"));
    std::filesystem::create_symlink("far/c", file("link"));
    ASSERT_EQ(run("-o no.exr --checkpoint link").exit_code, 0);
    EXPECT_TRUE(std::filesystem::is_symlink(file("link")));
    EXPECT_TRUE(std::filesystem::is_regular_file(file("far/c")));
    // The newest is damaged from its first byte on; the one before it stays until there is another.
    const std::string older = read_text(file("c.old"));
    std::ofstream(file("c")) << "Ar";
    ASSERT_EQ(run(std::string(long_render) + "-o resumed.exr --checkpoint c --resume c").exit_code,
              0);
    EXPECT_EQ(pixels("whole.exr"), pixels("resumed.exr"));
    EXPECT_EQ(read_text(file("c.old")), older);
    EXPECT_EQ(run(std::string(long_render) + "-o resumed.exr --resume c").exit_code, 0);
}

TEST_F(Checkpoints, KeepTheTimeOfABudget) {
    const std::string render_in_time = "render '" + asset("cornell_glass.glb") +
                                       "' --size 12x12 --spp 4 -q --method photons --photons "
                                       "200000 --budget 1.5 --json r.json ";
    ASSERT_EQ(argand(render_in_time + "-o a.exr --checkpoint c", on_host).exit_code, 0);
    const auto passes = [&] {
        return nlohmann::json::parse(read_text(file("r.json")))["passes"].get<int>();
    };
    const int before = passes();
    ASSERT_EQ(argand(render_in_time + "-o b.exr --resume c", on_host).exit_code, 0);
    EXPECT_EQ(passes(), before); // its time is over
    EXPECT_EQ(pixels("a.exr"), pixels("b.exr"));
}

TEST_F(Checkpoints, OfOtherRendersAreRefused) {
    ASSERT_EQ(run("-o whole.exr --photons 1000 --checkpoint c").exit_code, 0);
    const std::string kept = read_text(file("c"));
    const std::string at_any_size =
        "render '" + asset("cornell_glass.glb") + "' --spp 4 -q -o no.exr --resume c ";
    expect_failure(at_any_size + "--size 13x12 --photons 1000", failure,
                   "its size is 12x12, and not 13x12", on_host);
    expect_failure(at_any_size + "--size 12x12 --photons 2000", failure,
                   "its --photons is 1000, and not 2000", on_host);
    const std::string as_before = "--photons 1000 -o no.exr --resume c ";
    expect_error(as_before + "--seed 1", "its seed is 0, and not 1");
    expect_error(as_before + "--method knn", "its method is footprints, and not knn");
    expect_error(as_before + "--smoothing 3", "its --smoothing is auto, and not 3");
    expect_error(as_before + "--backend vulkan", "its backend is cpu, and not vulkan");
    expect_failure("render '" + asset("cornell_mirror.glb") + "' --size 12x12 --spp 4 -q " +
                       as_before,
                   failure, "its scene is cornell_glass.glb", on_host);
    EXPECT_EQ(read_text(file("c")), kept);
}

TEST_F(Checkpoints, DoNotReplaceThoseOfAnotherRender) {
    ASSERT_EQ(run("-o whole.exr --photons 1000 --checkpoint c").exit_code, 0);
    const std::string kept = read_text(file("c"));
    const std::string another = "-o no.exr --photons 2000 --checkpoint ";
    expect_error(another + "c", "'c' is that of a render before");
    std::filesystem::rename(file("c"), file("c.old"));
    expect_error(another + "c", "c.old' is that of a render before");
    expect_error(another + "c --resume d", "c.old' is that of a render before");
    // The one before that of the same name is another's.
    ASSERT_EQ(run("-o other.exr --photons 2000 --checkpoint d").exit_code, 0);
    std::filesystem::rename(file("d"), file("c"));
    expect_error(another + "c --resume c", "c.old', which is of another render");
    EXPECT_EQ(read_text(file("c.old")), kept);
    std::filesystem::remove(file("c"));
    std::filesystem::create_symlink("c", file("link"));
    EXPECT_EQ(run("-o again.exr --photons 1000 --checkpoint link --resume c").exit_code, 0);
    EXPECT_EQ(pixels("whole.exr"), pixels("again.exr"));
}

TEST_F(Checkpoints, OfAnotherVersionOrBuildAreRefused) {
    ASSERT_EQ(run("-o whole.exr --photons 1000 --checkpoint c").exit_code, 0);
    const std::string resume = "-o no.exr --photons 1000 --resume ";
    std::string bytes = read_text(file("c"));
    bytes[7] = '0'; // the version of the format
    write_text(file("d"), bytes);
    expect_error(resume + "d", "it is a checkpoint of another version of Argand");
    std::filesystem::copy_file(ARGAND_EXECUTABLE, file("other_build"));
    std::ofstream(file("other_build"), std::ios::app) << "it still runs";
    const Outcome other = argand("--version >/dev/null; " + std::string(on_host) +
                                 " ./other_build " + render(resume + "c 2>error"));
    EXPECT_EQ(other.exit_code, failure);
    EXPECT_THAT(read_text(file("error")), HasSubstr("resuming 'c': its build is "));
}

TEST_F(Checkpoints, SlowOfLongRendersHavePassesThatEndSoon) {
    for (const std::string method : {"path", "footprints", "photon-queue"}) {
        ASSERT_EQ(argand("render '" + asset("cornell_glass.glb") +
                             "' --size 64x64 --spp 257 --bounces 1 -q --json r.json --method " +
                             method + " -o " + method + ".exr",
                         on_host)
                      .exit_code,
                  0);
        // Of 2^20 paths at most, whatever the photons are.
        EXPECT_EQ(nlohmann::json::parse(read_text(file("r.json")))["passes"], 2) << method;
    }
}

TEST_F(Checkpoints, RefuseWhatTheyCannotDo) {
    std::ofstream(file("notes.txt")) << "do not lose me";
    expect_error("-o no.exr --checkpoint notes.txt", "there is something else of that name");
    EXPECT_EQ(read_text(file("notes.txt")), "do not lose me");
    expect_error("-o no.exr --resume notes.txt",
                 "it is not a checkpoint; choose another file, or render from the start");
    std::ofstream(file("c.old")) << "nor me";
    expect_error("-o no.exr --checkpoint c", "which is something else");
    EXPECT_EQ(read_text(file("c.old")), "nor me");
    ASSERT_EQ(::mkfifo(file("pipe").c_str(), 0600), 0);
    expect_error("-o no.exr --checkpoint pipe", "there is something else of that name");
    expect_error("-o no.exr --checkpoint " + std::string(253, 'x'), "xxx");
    expect_error("-o no.exr --checkpoint d --json d.old", "it would replace 'd.old'", usage);
    expect_error("-o no.exr --resume d --json d", "it would replace 'd'", usage);
    expect_error("-o no.exr --resume missing", "there is no such file");
    expect_error("-o no.exr --checkpoint folder/c", "folder");
    expect_error("-o no.exr --every 3", "it needs --checkpoint", usage);
    expect_error("-o no%d.exr --frames 0:2 --checkpoint c", "--continue", usage);
    expect_error("-o no.exr --target-error 0.1 --checkpoint c", "--target-error", usage);
    expect_error("-o no.exr --budget 1 --resume c", "--budget", usage);
    expect_error("-o no.exr --checkpoint no.exr", "no.exr", usage);
    expect_error("-o no.exr --checkpoint c --every -1", "--every", usage);
}

TEST_F(Checkpoints, SlowAreSavedWhenARenderIsInterrupted) {
    expect_same_picture_if_interrupted(long_render);
}

} // namespace
} // namespace argand::testing
