// argand view in a window, on a display that nobody sees (Xvfb).
#include "argand_run.hpp"

#include <filesystem>

namespace argand::testing {
namespace {

using ::testing::HasSubstr;

class Windows : public ArgandTest {
protected:
    void SetUp() override {
        if (!std::filesystem::exists(std::filesystem::path(ARGAND_EXECUTABLE).parent_path() /
                                     "argand-view")) {
            GTEST_SKIP() << "this build has no window: GLFW or Dear ImGui is missing";
        }
        if (std::system("command -v xvfb-run >/dev/null") != 0) {
            GTEST_SKIP() << "there is no xvfb-run, which has displays that nobody sees";
        }
    }

    /// On a display of its own, with a configuration folder of its own.
    static constexpr const char* on_display = "ARGAND_BACKEND=cpu XDG_CONFIG_HOME=config "
                                              "xvfb-run -a -s '-screen 0 800x600x24'";

    std::string view(const std::string& options) const {
        return "view '" + asset("cornell_point.glb") +
               "' --size 64x48 --photons 1000 --method photons " + options;
    }
};

TEST_F(Windows, ShowThePicturesOfAHeadlessView) {
    write_text(file("broken.glb"), "no glTF");
    write_text(file("script.json"), R"({"frames": 12, "events": [
        {"frame": 1, "edits": {"lights": {"point": {"position": [0.4, 1.2, 0.1]}}}},
        {"frame": 2, "size": [1, 1]},
        {"frame": 4, "method": "footprints", "size": [80, 20]},
        {"frame": 6, "open": "broken.glb", "expect": {"error": "broken.glb"}},
        {"frame": 7, "method": "photons", "size": [64, 48]},
        {"frame": 11, "screenshot": "shown.exr", "expect": {"passes": 4}}]})");
    const Outcome window = argand(view("--script script.json"), on_display);
    ASSERT_EQ(window.exit_code, 0) << window.error;
    std::filesystem::rename(file("shown.exr"), file("in_window.exr"));
    const Outcome headless = argand(view("-q --headless --script script.json"), on_host);
    ASSERT_EQ(headless.exit_code, 0) << headless.error;
    EXPECT_EQ(pixels("shown.exr"), pixels("in_window.exr"));
    EXPECT_TRUE(std::filesystem::exists(file("config/argand/view.ini")));
}

TEST_F(Windows, IgnoreABrokenConfiguration) {
    std::filesystem::create_directories(file("config/argand"));
    write_text(file("config/argand/view.ini"), std::string("[Window][\xff\n=Pos=,\n\0]]", 18));
    write_text(file("script.json"), R"({"frames": 3})");
    const Outcome run = argand(view("--script script.json"), on_display);
    EXPECT_EQ(run.exit_code, 0) << run.error;
    EXPECT_THAT(read_text(file("config/argand/view.ini")), HasSubstr("[Window][argand]"));
}

TEST_F(Windows, SayThatThereIsNoDisplay) {
    write_text(file("script.json"), R"({"frames": 1})");
    for (const char* display : {"", ":4711"}) {
        expect_failure(view("--script script.json -q"), failure, "--headless",
                       std::string("WAYLAND_DISPLAY= ARGAND_BACKEND=cpu DISPLAY=") + display);
    }
}

} // namespace
} // namespace argand::testing
