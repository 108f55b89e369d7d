#include "interactive/script.hpp"
#include "support/expect_error.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace argand {
namespace {

using testing::error_of;
using ::testing::HasSubstr;

Script script_of(const char* text) { return parse_script(nlohmann::json::parse(text), "s.json"); }

TEST(Scripts, AreReadInTheOrderOfFrames) {
    const Script script = script_of(R"({"frames": 9, "events": [
        {"frame": 5, "time": null, "save_edits": "a.json"},
        {"frame": 2, "edits": {"lights": {}}, "method": "knn",
         "options": {"photons": 1000, "progressive": true, "radius": "auto"},
         "size": [1, 2], "time": 0.5, "open": "b.glb", "screenshot": "c.png",
         "expect": {"moving": true, "passes": 3, "seconds": 1.5, "error": "no"}}]})");
    EXPECT_EQ(script.frames, 9u);
    ASSERT_EQ(script.events.size(), 2u);
    const ScriptEvent& first = script.events[0];
    EXPECT_EQ(first.frame, 2u);
    EXPECT_EQ(first.method, "knn");
    EXPECT_EQ(first.open, "b.glb");
    EXPECT_EQ(first.screenshot, "c.png");
    EXPECT_EQ(first.size, std::pair(1, 2));
    EXPECT_EQ(first.time, std::optional(std::optional(0.5)));
    EXPECT_EQ(first.options, (std::vector<std::pair<std::string, std::string>>{
                                 {"photons", "1000"}, {"progressive", "on"}, {"radius", "auto"}}));
    ASSERT_TRUE(first.expect && first.edits);
    EXPECT_EQ(first.expect->moving, true);
    EXPECT_EQ(first.expect->passes, 3u);
    EXPECT_EQ(first.expect->seconds, 1.5);
    EXPECT_EQ(first.expect->error, "no");
    const ScriptEvent& second = script.events[1];
    EXPECT_EQ(second.frame, 5u);
    ASSERT_TRUE(second.time); // to rest
    EXPECT_FALSE(*second.time);
    EXPECT_EQ(second.save_edits, "a.json");
    EXPECT_FALSE(second.edits || second.expect || second.method || second.size || second.open);
}

TEST(Scripts, NameTheEventThatIsWrong) {
    for (const auto& [text, message] : std::vector<std::pair<const char*, const char*>>{
             {"3", "the text is no JSON object"},
             {"{}", "'frames' of the text is not a number of frames, at least 1"},
             {R"({"frames": 0})", "at least 1"},
             {R"({"frames": -3})", "'frames' of the text is not a number"},
             {R"({"frames": 3, "events": {}})", "'events' of the text is not a list"},
             {R"({"frames": 3, "event": []})", "has a member 'event', which there is not"},
             {R"({"frames": 3, "events": [{}]})", "'frame' of event 0 is not a number from 0 to 2"},
             {R"({"frames": 3, "events": [{"frame": 3}]})", "a number from 0 to 2"},
             {R"({"frames": 3, "events": [{"frame": 0}, {"frame": 1, "zoom": 2}]})",
              "event 1 has a member 'zoom', which there is not"},
             {R"({"frames": 3, "events": [{"frame": 0, "size": [0, 4]}]})", "two numbers from 1"},
             {R"({"frames": 3, "events": [{"frame": 0, "size": [4]}]})", "two numbers from 1"},
             {R"({"frames": 3, "events": [{"frame": 0, "time": "now"}]})", "a number of seconds"},
             {R"({"frames": 3, "events": [{"frame": 0, "method": 3}]})", "is not a text"},
             {R"({"frames": 3, "events": [{"frame": 0, "edits": 3}]})",
              "is not an object of edits"},
             {R"({"frames": 3, "events": [{"frame": 0, "options": {"spp": []}}]})",
              "an object of texts, numbers"},
             {R"({"frames": 3, "events": [{"frame": 0, "expect": {"mean": 3}}]})",
              "'expect' of event 0 has a member 'mean'"}}) {
        const std::string error = error_of([&, text = text] { script_of(text); });
        EXPECT_THAT(error, HasSubstr("reading script 's.json': "));
        EXPECT_THAT(error, HasSubstr(message)) << text;
    }
}

} // namespace
} // namespace argand
