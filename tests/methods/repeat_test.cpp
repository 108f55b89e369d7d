// Images are equal to the bit from run to run, whatever the order of parallel work and whatever
// fast paths the device has.
#include "rendering.hpp"
#include "support/scratch_directory.hpp"

#include <cstdlib>

namespace argand::testing {
namespace {

/// Ways to work without what lavapipe has.
const DeviceSetting fallbacks[] = {{"serial", "subgroups,push_descriptors,timestamps", ""},
                                   {"subgroups", "lane_serial", ""},
                                   {"shared", "lane_serial,subgroups,push_descriptors", ""}};

/// Expects one picture from processes with different numbers of threads: a process fixes the number
/// of lavapipe's threads when it first uses lavapipe.
void expect_same_bits_with_threads(const std::string& options) {
    const ScratchDirectory directory;
    std::string pictures[2];
    for (int i = 0; i < 2; ++i) {
        // One name, for a picture holds the command that made it.
        const std::string output = (directory / "picture.exr").string();
        const std::string command = "ARGAND_VALIDATION=1 LP_NUM_THREADS=" + std::to_string(i + 1) +
                                    " '" ARGAND_EXECUTABLE "' render '" +
                                    ARGAND_SOURCE_DIR
                                    "/assets/cornell_glass.glb' -q --size 32x24 --spp 4" +
                                    options + " -o '" + output + "'";
        ASSERT_EQ(std::system(command.c_str()), 0) << command;
        pictures[i] = read_text(output);
    }
    EXPECT_FALSE(pictures[0].empty());
    EXPECT_TRUE(pictures[0] == pictures[1]);
}

class Repeat : public EveryMethod {
protected:
    RenderSettings settings(std::uint32_t seed = 0) const {
        RenderSettings settings = settings_of(GetParam(), 24, 4);
        settings.photons = 20'000;
        settings.seed = seed;
        return settings;
    }
};

TEST_P(Repeat, SeedsGiveTheirOwnBitsEachTime) {
    const Scene scene = load_asset("cornell_glass.glb");
    const RenderResult first = render(scene, settings());
    EXPECT_TRUE(same_bits(render(scene, settings()), first));
    EXPECT_FALSE(same_bits(layer(render(scene, settings(1)), ""), layer(first, "")));
}

TEST_P(Repeat, FallbacksGiveTheSameBits) {
    const Scene scene = load_asset("cornell_mirror.glb");
    const RenderResult expected = render(scene, settings());
    for (const DeviceSetting& way : fallbacks) {
        EXPECT_TRUE(same_bits(testing::render(open(way), scene, settings()), expected)) << way.name;
    }
}

TEST_P(Repeat, BatchesGiveTheSameBits) {
    // The result of a path does not depend on the paths in its batch, unless they share answers.
    // (Passes of photons are different: they are independent estimates.)
    RenderSettings batched = settings();
    batched.query_cell = 0;
    batched.width = 97;
    batched.height = 61;
    batched.samples = 5;
    batched.photons = 5000;
    const Scene scene = load_asset("cornell_area.glb");
    const RenderResult expected = render(scene, batched);
    Device& limited =
        open({"limited", "",
              has_approximate_hits(GetParam()) ? "storage_range=16MiB" : "storage_range=1MiB"});
    const RenderResult found = testing::render(limited, scene, batched);
    if (has_light_paths(GetParam())) {
        // A pixel's splats are added batch by batch, so that other batches round otherwise.
        expect_same_layers(found, expected, 1e-5);
        return;
    }
    EXPECT_TRUE(same_bits(found, expected));
}

TEST_P(Repeat, ThreadsGiveTheSameBits) {
    expect_same_bits_with_threads(
        (has_map(GetParam()) ? " --photons 20000 --method " : " --method ") + GetParam());
}

/// The same where queries are answered together, by the methods with a search of their own.
class RepeatTogether : public RenderTest, public ::testing::WithParamInterface<std::string> {};

TEST_P(RepeatTogether, FallbacksGiveTheSameBits) {
    RenderSettings settings = settings_of(GetParam(), 24, 4);
    settings.photons = 20'000;
    settings.query = QuerySearch::simultaneous;
    const Scene scene = load_asset("cornell_glass.glb");
    const RenderResult expected = render(scene, settings);
    for (const DeviceSetting& way : fallbacks) {
        EXPECT_TRUE(same_bits(testing::render(open(way), scene, settings), expected)) << way.name;
    }
}

TEST_P(RepeatTogether, ThreadsGiveTheSameBits) {
    expect_same_bits_with_threads(" --photons 20000 --query simultaneous --method " + GetParam());
}

INSTANTIATE_TEST_SUITE_P(Methods, RepeatTogether, ::testing::Values("photons", "footprints"),
                         [](const auto& method) { return test_name(method.param); });

TEST(RepeatFilm, ThreadsGiveThePhotonsQueueTheSameBits) {
    const ScratchDirectory directory;
    const std::string output = (directory / "frame_%d.exr").string();
    for (const char* backend : {"", " --backend cpu"}) {
        std::string last[2];
        for (int i = 0; i < 2; ++i) {
            const std::string threads = std::to_string(1 + 2 * i);
            const std::string command =
                "LP_NUM_THREADS=" + threads + " OMP_NUM_THREADS=" + threads +
                " '" ARGAND_EXECUTABLE "' render '" + ARGAND_SOURCE_DIR +
                "/assets/dynamic_block.glb' -q --frames 0:3 --size 16x16 --spp 2 --photons 8000 "
                "--method photon-queue --window 4 -o '" +
                output + "'" + backend;
            ASSERT_EQ(std::system(command.c_str()), 0) << command;
            last[i] = read_text(directory / "frame_2.exr");
        }
        EXPECT_FALSE(last[0].empty());
        EXPECT_TRUE(last[0] == last[1]) << backend;
    }
}

INSTANTIATE_METHODS(Repeat);

} // namespace
} // namespace argand::testing
