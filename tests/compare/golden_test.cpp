#include "compare/backends.hpp"
#include "device_fixture.hpp"
#include "scene/fingerprint.hpp"
#include "scene/gltf.hpp"
#include "support/expect_error.hpp"
#include "support/scratch_directory.hpp"

#include <fstream>

namespace argand {
namespace {

using argand::testing::error_of;
using argand::testing::ScratchDirectory;
using ::testing::HasSubstr;

TEST(GoldenChanges, ReproduceTheChangedState) {
    const std::vector<std::uint32_t> before{1, 2, 3, 4, 5, 6};
    const std::vector<std::uint32_t> after{1, 9, 8, 4, 5, 7};
    const GoldenWrite write = changes(before, after);
    EXPECT_EQ(write.runs.size(), 2u);
    EXPECT_EQ(write.words, (std::vector<std::uint32_t>{9, 8, 7}));
    std::vector<std::uint32_t> words = before;
    apply_changes(write, words);
    EXPECT_EQ(words, after);
    EXPECT_TRUE(changes(after, after).runs.empty());
    EXPECT_EQ(write.size, 6u);
    words.resize(4);
    EXPECT_THAT(error_of([&] { apply_changes(write, words); }), HasSubstr("record it anew"));
}

class GoldenFile : public DeviceTest {
protected:
    /// Records a capture of a small image.
    Golden record(Device& device, const Scene& scene) {
        Golden golden{.scene = scene.name,
                      .fingerprint = fingerprint(scene),
                      .device = device.info().name,
                      .driver = device.info().driver,
                      .revision = "test",
                      .features = {.lane_serial = device.info().lane_serial()},
                      .width = 6,
                      .height = 6,
                      .samples = 1,
                      .seed = 2,
                      .photons = 300,
                      .captures = {}};
        golden.captures["photons"] = record_golden(device, scene, settings_of(golden, "photons"));
        return golden;
    }

    const Scene scene_ = load_gltf(ARGAND_SOURCE_DIR "/assets/cornell_glass.glb");
};

TEST_F(GoldenFile, RoundTripsACapture) {
    Device& device = open();
    const Golden golden = record(device, scene_);
    const ScratchDirectory directory;
    write_golden(directory / "a.golden", golden);
    const Golden read = read_golden(directory / "a.golden");
    EXPECT_EQ(read.device, device.info().name);
    EXPECT_EQ(read.photons, 300u);
    ASSERT_TRUE(read.captures.contains("photons"));
    const GoldenCapture& a = golden.captures.at("photons");
    const GoldenCapture& b = read.captures.at("photons");
    ASSERT_EQ(a.size(), b.size());
    for (std::size_t i = 0; i < a.size(); ++i) {
        EXPECT_EQ(a[i].stage, b[i].stage);
        ASSERT_EQ(a[i].writes.size(), b[i].writes.size());
        for (std::size_t j = 0; j < a[i].writes.size(); ++j) {
            EXPECT_EQ(a[i].writes[j].words, b[i].writes[j].words);
        }
    }
    const std::vector<StageComparison> found = compare_with_golden(read, "photons", device, scene_);
    EXPECT_GT(found.size(), 20u);
    for (const StageComparison& stage : found) {
        EXPECT_EQ(stage.unequal, 0u) << stage.name;
    }
}

TEST_F(GoldenFile, AChangedWordIsFound) {
    Device& device = open();
    Golden golden = record(device, scene_);
    GoldenStep& last = golden.captures["photons"].back();
    ASSERT_EQ(last.stage, "film_add");
    last.writes.front().words.front() ^= 0x00800000u;
    const std::vector<StageComparison> found =
        compare_with_golden(golden, "photons", device, scene_);
    for (const StageComparison& stage : found) {
        EXPECT_EQ(passes_isolated(stage), stage.name != "film_add") << stage.name;
    }
}

TEST_F(GoldenFile, OtherScenesAndMethodsAreErrors) {
    Device& device = open();
    const Golden golden = record(device, scene_);
    EXPECT_THAT(error_of([&] { compare_with_golden(golden, "path", device, scene_); }),
                HasSubstr("method path"));
    Scene other = load_gltf(ARGAND_SOURCE_DIR "/assets/ring.glb");
    EXPECT_THAT(error_of([&] { compare_with_golden(golden, "photons", device, other); }),
                HasSubstr("record it anew"));
    other.name = golden.scene;
    EXPECT_THAT(error_of([&] { compare_with_golden(golden, "photons", device, other); }),
                HasSubstr("record it anew"));
    // A capture with more or fewer steps than the render.
    Golden longer = golden;
    longer.captures["photons"].push_back({"sort", {}});
    EXPECT_THAT(error_of([&] { compare_with_golden(longer, "photons", device, scene_); }),
                HasSubstr("was not run"));
    longer.captures["photons"].resize(longer.captures["photons"].size() - 2);
    EXPECT_THAT(error_of([&] { compare_with_golden(longer, "photons", device, scene_); }),
                HasSubstr("not film_add"));
}

TEST_F(GoldenFile, InvalidFilesAreErrors) {
    const ScratchDirectory directory;
    EXPECT_THAT(error_of([&] { read_golden(directory / "missing.golden"); }),
                HasSubstr("missing.golden"));
    for (const std::string text : {"", "short", "0123456789abcdef0123456789abcdef"}) {
        std::ofstream(directory / "bad.golden") << text;
        EXPECT_THAT(error_of([&] { read_golden(directory / "bad.golden"); }),
                    HasSubstr("bad.golden"))
            << text;
    }
    Golden none = record(open(), scene_);
    none.captures.clear();
    write_golden(directory / "none.golden", none);
    EXPECT_THAT(error_of([&] { read_golden(directory / "none.golden"); }),
                HasSubstr("is empty or has surplus data"));
    none = record(open(), scene_);
    none.photons = std::uint64_t(1) << 62;
    write_golden(directory / "huge.golden", none);
    EXPECT_THAT(error_of([&] { read_golden(directory / "huge.golden"); }),
                HasSubstr("out of range"));
    write_golden(directory / "cut.golden", record(open(), scene_));
    std::filesystem::resize_file(directory / "cut.golden",
                                 std::filesystem::file_size(directory / "cut.golden") / 2);
    EXPECT_THAT(error_of([&] { read_golden(directory / "cut.golden"); }), HasSubstr("cut.golden"));
}

// Captures in the repository: this device must agree with them.
TEST_F(GoldenFile, ThisDeviceAgreesWithRecordedDevices) {
    Device& device = open();
    int files = 0;
    for (const auto& entry :
         std::filesystem::directory_iterator(ARGAND_SOURCE_DIR "/assets/golden")) {
        if (entry.path().extension() != ".golden") {
            continue;
        }
        ++files;
        const Golden golden = read_golden(entry.path());
        const Scene scene = load_gltf(ARGAND_SOURCE_DIR "/assets/" + golden.scene);
        for (const auto& [method, capture] : golden.captures) {
            for (const StageComparison& stage :
                 compare_with_golden(golden, method, device, scene)) {
                EXPECT_TRUE(passes_isolated(stage))
                    << golden.scene << ", " << method << ": " << stage.name << ", " << stage.unequal
                    << " of " << stage.items;
            }
        }
    }
    EXPECT_GT(files, 0);
}

} // namespace
} // namespace argand
