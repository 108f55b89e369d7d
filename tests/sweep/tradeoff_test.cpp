#include "image/exr.hpp"
#include "support/expect_error.hpp"
#include "sweep/fake.hpp"

#include <sstream>

namespace argand::testing {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

TEST_F(TradeoffTest, MeasuresEverySettingOnce) {
    FakeRenderer renderer;
    const Results results = run(renderer, scene_, request("a"));
    EXPECT_TRUE(results.complete);
    const auto settings =
        sweep(scene_, request("a").base, {"photons", "path"}, results.learnt, Extent::quick);
    ASSERT_EQ(results.measurements.size(), settings.size());
    for (std::size_t i = 0; i < settings.size(); ++i) {
        EXPECT_EQ(results.measurements[i].key, parameter_key(settings[i].render));
        EXPECT_TRUE(std::filesystem::exists(scratch_ / "a" / results.measurements[i].picture));
    }
}

TEST_F(TradeoffTest, ResumesAnInterruptedSweep) {
    FakeRenderer whole;
    run(whole, scene_, request("whole"));
    interrupt(whole, [&](const std::string& folder, const Results& before) {
        EXPECT_FALSE(before.complete);
        FakeRenderer second;
        const Results after = run(second, scene_, request(folder));
        EXPECT_TRUE(after.complete);
        for (const Measurement& known : before.measurements) {
            EXPECT_THAT(second.keys, Not(::testing::Contains(known.key)));
        }
        for (const char* file : {"tradeoff.json", "tradeoff.csv", "reference.exr"}) {
            EXPECT_EQ(text(folder + "/" + file), text(std::string("whole/") + file)) << file;
        }
    });
}

TEST_F(TradeoffTest, RendersNothingIfComplete) {
    FakeRenderer first, second;
    run(first, scene_, request("a"));
    run(second, scene_, request("a"));
    EXPECT_THAT(second.keys, IsEmpty());
}

TEST_F(TradeoffTest, MeasuresASettingAgainIfItsPictureIsLost) {
    FakeRenderer first, second;
    const Results results = run(first, scene_, request("a"));
    std::filesystem::remove(scratch_ / "a" / results.measurements[1].picture);
    run(second, scene_, request("a"));
    EXPECT_THAT(second.keys, ::testing::ElementsAre(results.measurements[1].key));
}

TEST_F(TradeoffTest, ContinuesAfterASettingThatFails) {
    FakeRenderer renderer;
    renderer.before = [](const RenderSettings& s) {
        if (s.method == "photons" && s.photons == 10'000) {
            run_out_of_memory();
        }
    };
    const Results results = run(renderer, scene_, request("a"));
    EXPECT_TRUE(results.complete);
    ASSERT_EQ(results.failures.size(), 1u);
    EXPECT_EQ(results.failures[0].options, "--method photons --photons 10000");
    FakeRenderer again;
    EXPECT_THAT(run(again, scene_, request("a")).failures, IsEmpty());
    EXPECT_EQ(again.keys.size(), 1u);
}

TEST_F(TradeoffTest, MeasuresOtherSettingsIfTheLargestRunsOutOfMemory) {
    FakeRenderer whole;
    const std::size_t all = run(whole, scene_, request("whole")).measurements.size();
    const auto measured_with = [&](const std::string& folder,
                                   const std::function<void()>& give_up) {
        FakeRenderer renderer;
        renderer.before = [&](const RenderSettings& s) {
            if (s.method == "photons" && s.photons == 1'000'000) {
                give_up();
            }
        };
        const Results results = run(renderer, scene_, request(folder));
        EXPECT_TRUE(results.complete);
        EXPECT_EQ(results.failures.size(), 1u);
        EXPECT_EQ(results.failures.at(0).options, "--method photons --photons 1000000");
        EXPECT_THAT(results.failures.at(0).why, HasSubstr("out of memory"));
        return results.measurements.size();
    };
    EXPECT_EQ(measured_with("a", run_out_of_memory), all - 1);
    EXPECT_EQ(measured_with("b", [] { throw std::bad_alloc(); }), all - 1);
}

TEST_F(TradeoffTest, MeasuresOtherMethodsIfOneCannotBeRendered) {
    FakeRenderer renderer;
    renderer.before = [](const RenderSettings& s) {
        if (s.method == "photons") {
            run_out_of_memory();
        }
    };
    const Results results = run(renderer, scene_, request("a"));
    EXPECT_TRUE(results.complete);
    EXPECT_EQ(results.measurements.size(),
              sweep(scene_, request("a").base, {"path"}, {}, Extent::quick).size());
    EXPECT_THAT(results.failures, Not(IsEmpty()));
    // Once it can be rendered, the sweep varies its bandwidth too.
    FakeRenderer again, whole;
    EXPECT_EQ(run(again, scene_, request("a")).measurements.size(),
              run(whole, scene_, request("b")).measurements.size());
}

TEST_F(TradeoffTest, MeasuresAMethodNamedTwiceOnce) {
    TradeoffRequest twice = request("a");
    twice.methods = {"path", "path"};
    FakeRenderer first, second;
    const Results results = run(first, scene_, twice);
    EXPECT_TRUE(results.complete);
    EXPECT_EQ(results.measurements.size(),
              sweep(scene_, twice.base, {"path"}, {}, Extent::quick).size());
    run(second, scene_, twice);
    EXPECT_THAT(second.keys, IsEmpty());
}

TEST_F(TradeoffTest, RendersALostReferenceAgain) {
    FakeRenderer first, second;
    run(first, scene_, request("a"));
    const std::string before = text("a/reference.exr"), csv = text("a/tradeoff.csv");
    std::filesystem::remove(scratch_ / "a/reference.exr");
    EXPECT_TRUE(run(second, scene_, request("a")).complete);
    EXPECT_EQ(text("a/reference.exr"), before);
    EXPECT_EQ(text("a/tradeoff.csv"), csv);
    write_text(scratch_ / "a/reference.exr", before.substr(0, before.size() / 2));
    EXPECT_THAT(error_of([&] { run(second, scene_, request("a")); }),
                HasSubstr("remove it to render it again"));
}

TEST_F(TradeoffTest, ReadsALostGivenReferenceAgain) {
    write_exr(scratch_ / "true.exr", std::array{Layer{"", noisy(16, 16, 0, 0.01, 99)}});
    TradeoffRequest given = request("a");
    given.reference_files = {scratch_ / "true.exr"};
    FakeRenderer first, second;
    run(first, scene_, given);
    const std::string before = text("a/reference.exr");
    std::filesystem::remove(scratch_ / "a/reference.exr");
    EXPECT_TRUE(run(second, scene_, given).complete);
    EXPECT_THAT(second.keys, IsEmpty());
    EXPECT_EQ(text("a/reference.exr"), before);
}

TEST_F(TradeoffTest, MoreTimeForAFinishedReferenceDoesNotChangeTheRun) {
    FakeRenderer first, second;
    run(first, scene_, request("a"));
    TradeoffRequest longer = request("a");
    longer.reference_seconds = 5;
    EXPECT_TRUE(run(second, scene_, longer).complete);
    EXPECT_THAT(second.keys, IsEmpty());
}

TEST_F(TradeoffTest, DoesNotMixRuns) {
    FakeRenderer renderer;
    run(renderer, scene_, request("a"));
    TradeoffRequest other = request("a");
    other.seeds = 3;
    EXPECT_THAT(
        error_of([&] { run(renderer, scene_, other); }),
        HasSubstr("another seeds (2, now 3); remove the folder, or choose another with -o"));
    other = request("a");
    other.run["scene"] = "another.glb";
    other.run["build"] = "b";
    other.base.height = 8;
    EXPECT_THAT(error_of([&] { run(renderer, scene_, other); }),
                HasSubstr("another scene (cornell_area.glb, now another.glb), height (16, now 8), "
                          "build (none, now b);"));
    write_text(scratch_ / "a/tradeoff.json", "{\"run\": ");
    EXPECT_THAT(error_of([&] { run(renderer, scene_, request("a")); }),
                ::testing::HasSubstr("tradeoff.json"));
}

TEST_F(TradeoffTest, CsvAgreesWithJson) {
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
        EXPECT_EQ(cells[1], m.option);
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

TEST_F(TradeoffTest, OneSeedAndABlackScene) {
    const Results results = run_on_a_black_scene(request("dark"));
    EXPECT_TRUE(results.complete);
    ASSERT_EQ(results.measurements.size(), 2u);
    EXPECT_EQ(results.measurements[0].rel_mse.mean, 0);
    EXPECT_EQ(front_of(results).size(), 1u);
}

} // namespace
} // namespace argand::testing
