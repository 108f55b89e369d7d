#include "fake.hpp"
#include "methods/scenes.hpp"
#include "scene/gltf.hpp"
#include "support/expect_error.hpp"

#include <regex>
#include <sstream>

namespace argand::testing {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

class TradeoffTest : public ::testing::Test {
protected:
    TradeoffRequest request(const std::string& folder) const {
        TradeoffRequest request{.run = {{"scene", "cornell_area.glb"}}, .methods = {"photons", "path"}};
        request.extent = Extent::quick;
        request.base.width = request.base.height = 16;
        request.reference_seconds = 0;
        request.seeds = 2;
        request.folder = scratch_ / folder;
        return request;
    }

    std::string text(const std::string& file) const { return read_text(scratch_ / file); }

    ScratchDirectory scratch_;
    Scene scene_ = load_gltf(ARGAND_SOURCE_DIR "/assets/cornell_area.glb");
};

TEST_F(TradeoffTest, MeasuresEverySettingOnce) {
    FakeRenderer renderer;
    const Results results = run(renderer, scene_, request("a"));
    EXPECT_TRUE(results.complete);
    const auto settings = sweep(scene_, request("a").base, {"photons", "path"}, results.learnt, Extent::quick);
    ASSERT_EQ(results.measurements.size(), settings.size());
    for (std::size_t i = 0; i < settings.size(); ++i) {
        EXPECT_EQ(results.measurements[i].key, parameter_key(settings[i].render));
        EXPECT_TRUE(std::filesystem::exists(scratch_ / "a" / results.measurements[i].picture));
    }
}

TEST_F(TradeoffTest, InterruptedGoesOnWhereItStopped) {
    FakeRenderer whole;
    run(whole, scene_, request("whole"));
    for (std::size_t stop = 0; stop < whole.keys.size(); stop += 3) {
        const std::string folder = "part" + std::to_string(stop);
        FakeRenderer first(static_cast<int>(stop)), second;
        const Results before = run(first, scene_, request(folder));
        EXPECT_FALSE(before.complete);
        const Results after = run(second, scene_, request(folder));
        EXPECT_TRUE(after.complete);
        for (const Measurement& known : before.measurements) {
            EXPECT_THAT(second.keys, Not(::testing::Contains(known.key)));
        }
        for (const char* file : {"tradeoff.json", "tradeoff.csv", "tradeoff.html", "tradeoff.png", "reference.exr"}) {
            EXPECT_EQ(text(folder + "/" + file), text(std::string("whole/") + file)) << file << " after " << stop;
        }
    }
}

TEST_F(TradeoffTest, AFinishedOneRendersNothing) {
    FakeRenderer first, second;
    run(first, scene_, request("a"));
    run(second, scene_, request("a"));
    EXPECT_THAT(second.keys, IsEmpty());
}

TEST_F(TradeoffTest, MeasuresAgainWhatLostItsPicture) {
    FakeRenderer first, second;
    const Results results = run(first, scene_, request("a"));
    std::filesystem::remove(scratch_ / "a" / results.measurements[1].picture);
    run(second, scene_, request("a"));
    EXPECT_THAT(second.keys, ::testing::ElementsAre(results.measurements[1].key));
}

TEST_F(TradeoffTest, GoesOnAfterASettingThatFails) {
    FakeRenderer renderer;
    const auto failing = [&](const RenderSettings& s, std::span<const std::uint32_t> seeds) {
        if (s.method == "photons" && s.photons == 10'000) {
            fail("allocating 'photons': the device is out of memory");
        }
        return renderer.trials()(s, seeds);
    };
    const Results results = measure_tradeoff(request("a"), scene_, failing, [](std::string_view, double) {});
    EXPECT_TRUE(results.complete);
    ASSERT_EQ(results.failures.size(), 1u);
    EXPECT_EQ(results.failures[0].options, "--method photons --photons 10000");
    EXPECT_THAT(text("a/tradeoff.html"), HasSubstr("out of memory"));
    FakeRenderer again;
    EXPECT_THAT(run(again, scene_, request("a")).failures, IsEmpty());
    EXPECT_EQ(again.keys.size(), 1u);
}

TEST_F(TradeoffTest, DoesNotMixRuns) {
    FakeRenderer renderer;
    run(renderer, scene_, request("a"));
    TradeoffRequest other = request("a");
    other.seeds = 3;
    EXPECT_THAT(error_of([&] { run(renderer, scene_, other); }), ::testing::HasSubstr("another folder"));
    other = request("a");
    other.run["scene"] = "another.glb";
    EXPECT_THAT(error_of([&] { run(renderer, scene_, other); }), ::testing::HasSubstr("another folder"));
    write_text(scratch_ / "a/tradeoff.json", "{\"run\": ");
    EXPECT_THAT(error_of([&] { run(renderer, scene_, request("a")); }), ::testing::HasSubstr("tradeoff.json"));
}

TEST_F(TradeoffTest, CsvSaysWhatJsonSays) {
    FakeRenderer renderer;
    run(renderer, scene_, request("a"));
    const Results results = read_results(scratch_ / "a/tradeoff.json");
    std::istringstream lines(text("a/tradeoff.csv"));
    std::string line;
    ASSERT_TRUE(std::getline(lines, line));
    const auto columns = static_cast<std::size_t>(std::count(line.begin(), line.end(), ',')) + 1;
    for (const Measurement& m : results.measurements) {
        ASSERT_TRUE(std::getline(lines, line));
        std::vector<std::string> cells;
        std::istringstream row(line);
        for (std::string cell; std::getline(row, cell, ',');) {
            cells.push_back(cell);
        }
        ASSERT_EQ(cells.size(), columns);
        EXPECT_EQ(cells[0], m.method);
        EXPECT_EQ(cells[1], m.knob);
        EXPECT_EQ(cells[2], m.value);
        EXPECT_EQ(std::stod(cells[3]), m.wall_seconds);
        EXPECT_EQ(std::stod(cells[4]), *m.device_seconds);
        EXPECT_EQ(std::stoull(cells[5]), m.peak_bytes);
        EXPECT_EQ(std::stod(cells[6]), m.rel_mse.mean);
        EXPECT_EQ(std::stod(cells[8]), m.ssim.mean);
        EXPECT_EQ(std::stod(cells[10]), *m.bias);
        EXPECT_EQ(std::stod(cells[11]), *m.variance);
        EXPECT_EQ(cells[14], m.options);
    }
    EXPECT_FALSE(std::getline(lines, line));
}

TEST_F(TradeoffTest, PageRefersToNothingOutside) {
    FakeRenderer renderer;
    run(renderer, scene_, request("a"));
    const std::string page = text("a/tradeoff.html");
    EXPECT_FALSE(std::regex_search(page, std::regex(R"((src|href)\s*=\s*"(?!data:))"))) << page.substr(0, 1000);
    for (const char* outside : {"http:", "https:", "<link", "<script", "@import", "url("}) {
        EXPECT_THAT(page, Not(HasSubstr(outside)));
    }
    EXPECT_THAT(page, HasSubstr("<svg"));
    EXPECT_THAT(page, HasSubstr("data:image/png;base64,iVBORw0KGgo"));
}

TEST_F(TradeoffTest, OneSeedAndABlackScene) {
    Scene dark;
    add_floor(dark, 1, 0, add_material(dark, lambertian(glm::vec3(0.5f))));
    const RenderTrials black = [](const RenderSettings& s, std::span<const std::uint32_t> seeds) {
        const Image image{s.width, s.height, std::vector<glm::vec3>(static_cast<std::size_t>(s.width * s.height))};
        return Trials{std::vector<Trial>(seeds.size(), Trial{.picture = image, .wall_seconds = 1}), 1};
    };
    TradeoffRequest one = request("dark");
    one.seeds = 1;
    const Results results = measure_tradeoff(one, dark, black, [](std::string_view, double) {});
    EXPECT_TRUE(results.complete);
    ASSERT_EQ(results.measurements.size(), 2u);
    EXPECT_EQ(results.measurements[0].rel_mse.mean, 0);
    EXPECT_FALSE(std::regex_search(text("dark/tradeoff.html"), std::regex("\\b(nan|inf)\\b")));
}

} // namespace
} // namespace argand::testing
