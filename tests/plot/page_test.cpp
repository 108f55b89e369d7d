#include "plot/page.hpp"

#include "sweep/fake.hpp"

#include <regex>

namespace argand::testing {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

class PageTest : public TradeoffTest {
protected:
    /// The page with these results, drawn in this folder.
    std::string page(const std::string& folder, const Results& results) const {
        draw_results(scratch_ / folder, results);
        return text(folder + "/tradeoff.html");
    }
};

TEST_F(PageTest, AResumedSweepHasThePageOfACompleteOne) {
    FakeRenderer whole;
    const std::string expected = page("whole", run(whole, scene_, request("whole")));
    interrupt(whole, [&](const std::string& folder, const Results& before) {
        draw_results(scratch_ / folder, before);
        FakeRenderer second;
        EXPECT_EQ(page(folder, run(second, scene_, request(folder))), expected);
        EXPECT_EQ(text(folder + "/tradeoff.svg"), text("whole/tradeoff.svg"));
    });
}

TEST_F(PageTest, DrawsNothingWithoutAReference) {
    FakeRenderer none(0);
    draw_results(scratch_ / "a", run(none, scene_, request("a")));
    EXPECT_FALSE(std::filesystem::exists(scratch_ / "a/tradeoff.html"));
}

TEST_F(PageTest, ListsFailures) {
    FakeRenderer renderer;
    renderer.before = [](const RenderSettings& s) {
        if (s.method == "photons" && s.photons == 10'000) {
            run_out_of_memory();
        }
    };
    const Results results = run(renderer, scene_, request("a"));
    EXPECT_THAT(page("a", results), HasSubstr("out of memory"));
}

TEST_F(PageTest, TellsWhatTheReferenceIsAndMisses) {
    FakeRenderer renderer;
    const std::string area = page("area", run(renderer, scene_, request("area")));
    EXPECT_THAT(area, HasSubstr("by the method path, "));
    EXPECT_THAT(area, Not(HasSubstr("may miss caustics")));
    // A point light and a mirror.
    const Scene ring = load_gltf(ARGAND_SOURCE_DIR "/assets/ring.glb");
    for (int times = 0; times < 2; ++times) { // the second results are read from their file
        const std::string html = page("ring", run(renderer, ring, request("ring")));
        EXPECT_THAT(html, HasSubstr("by the method bidirectional, "));
        EXPECT_THAT(html, HasSubstr("may miss caustics"));
    }
}

TEST_F(PageTest, RefersToNothingOutside) {
    FakeRenderer renderer;
    const std::string html = page("a", run(renderer, scene_, request("a")));
    EXPECT_FALSE(std::regex_search(html, std::regex(R"((src|href)\s*=\s*"(?!data:))")))
        << html.substr(0, 1000);
    for (const char* outside : {"http:", "https:", "<link", "<script", "@import", "url("}) {
        EXPECT_THAT(html, Not(HasSubstr(outside)));
    }
    EXPECT_THAT(html, HasSubstr("<svg"));
    EXPECT_THAT(html, HasSubstr("data:image/png;base64,iVBORw0KGgo"));
}

TEST_F(PageTest, ShowsOneSeedOfABlackScene) {
    const std::string html = page("dark", run_on_a_black_scene(request("dark")));
    EXPECT_THAT(html, HasSubstr("no measurable error"));
    EXPECT_FALSE(std::regex_search(html, std::regex("\\b(nan|inf)\\b")));
}

} // namespace
} // namespace argand::testing
