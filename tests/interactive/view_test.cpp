#include "device_fixture.hpp"
#include "image/files.hpp"
#include "interactive/run_script.hpp"
#include "scene/gltf.hpp"
#include "session/render.hpp"
#include "support/expect_error.hpp"
#include "support/scratch_directory.hpp"
#include "world/world.hpp"

#include <filesystem>
#include <fstream>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace argand {
namespace {

using nlohmann::json;
using testing::error_of;
using ::testing::HasSubstr;

std::string asset(const std::string& name) { return ARGAND_SOURCE_DIR "/assets/" + name; }

Scene load(const std::string& file, std::optional<double> seconds, bool movable_nodes) {
    return load_gltf(file, seconds, {.movable_nodes = movable_nodes});
}

class Views : public DeviceTest {
protected:
    static ViewSettings settings(const std::string& method = "photons") {
        ViewSettings settings{.passes = 4, .frame_seconds = 0.02};
        settings.still.method = method;
        settings.still.width = 24;
        settings.still.height = 20;
        settings.still.samples = 1;
        settings.still.photons = 2000;
        if (method == "image-space") {
            settings.still.own["map-size"] = "16";
        }
        return settings;
    }

    View view(const std::string& name = "cornell_point.glb",
              const ViewSettings& settings = Views::settings()) {
        return {open(), load(asset(name), {}, false), asset(name), load, settings};
    }

    /// The picture of `argand render` with the view's settings, edits and moment.
    Image rendered(const View& view) {
        const Edits edits = parse_edits(view.edits(), "edits");
        Scene scene = load(view.file(), view.time(), edits.has_nodes);
        SceneEditor(scene).apply(edits, scene);
        return render(open(), scene, view.equivalent(), [](double) { return true; })
            .layers.front()
            .image;
    }

    static void refine(View& view, std::uint64_t passes) {
        while (view.frame().passes < passes) {
        }
    }
};

TEST_F(Views, AtRestShowThePicturesOfRender) {
    for (const char* method : {"photons", "progressive", "knn", "footprints", "path"}) {
        View shown = view("cornell_point.glb", settings(method));
        const ViewFrame first = shown.frame();
        EXPECT_TRUE(first.moving);
        EXPECT_EQ(first.passes, 0u);
        EXPECT_EQ(shown.picture().width, 24);
        EXPECT_EQ(shown.picture().height, 20);
        for (std::uint64_t passes = 1; passes <= 3; ++passes) {
            const ViewFrame frame = shown.frame();
            EXPECT_FALSE(frame.moving);
            EXPECT_EQ(frame.passes, passes);
            EXPECT_EQ(shown.picture().pixels, rendered(shown).pixels)
                << method << " after " << passes << " passes";
        }
        // Then there are no more.
        refine(shown, 4);
        const Image last = shown.picture();
        EXPECT_EQ(shown.frame().passes, 4u);
        EXPECT_EQ(shown.picture().pixels, last.pixels);
        EXPECT_GT(shown.layers().size(), 1u);
    }
}

TEST_F(Views, OfMethodsThatKeepPhotonsComeToRest) {
    View shown = view("cornell_point.glb", settings("photon-queue"));
    shown.set_option("queue-fill", "gradual");
    shown.frame();
    std::vector<glm::vec3> before;
    int frames = 0;
    while (frames < 40 && before != shown.picture().pixels) {
        before = shown.picture().pixels;
        EXPECT_FALSE(shown.frame().moving);
        ++frames;
    }
    EXPECT_GT(frames, 4) << "its window takes several frames to fill";
    EXPECT_LT(frames, 40);
}

TEST_F(Views, FollowEdits) {
    View shown = view();
    const std::vector<json> patches{
        {{"lights", {{"point", {{"position", {0.5, 1, 0.3}}}}}}},
        {{"nodes", {{"tall box", {{"translation", {0.3, 0.1, 0.2}}}}}}},
        {{"materials", {{"floor", {{"base_color", {0.1, 0.2, 0.7}}, {"metallic", 0.5}}}}}},
        {{"cameras", {{"0", {{"position", {0.4, 1.2, 3}}, {"target", {0, 1, 0}}}}}}},
        {{"materials", {{"tall box", {{"emission", {2, 1, 0}}}}}}},
        {{"sun", {{"elevation", 40}, {"azimuth", 150}}}}};
    std::vector<glm::vec3> before;
    for (const json& patch : patches) {
        shown.edit(patch);
        EXPECT_TRUE(shown.frame().moving);
        EXPECT_FALSE(shown.frame().moving);
        EXPECT_NE(shown.picture().pixels, before) << patch;
        EXPECT_EQ(shown.picture().pixels, rendered(shown).pixels) << patch;
        before = shown.picture().pixels;
    }
    EXPECT_EQ(shown.edits().size(), 5u); // of lights, nodes, materials, cameras and the sun
}

TEST_F(Views, ShowTheSameAsBeforeWhatIsPutBack) {
    View shown = view();
    refine(shown, 2);
    const Image before = shown.picture();
    for (const float x : {0.1f, 0.2f, 0.3f}) {
        shown.edit({{"lights", {{"point", {{"position", {x, 1, 0}}}}}}});
        shown.frame();
    }
    refine(shown, 2);
    EXPECT_NE(shown.picture().pixels, before.pixels);
    shown.edit({{"lights", {{"point", nullptr}}}});
    EXPECT_TRUE(shown.frame().moving);
    refine(shown, 2);
    EXPECT_EQ(shown.picture().pixels, before.pixels);
}

TEST_F(Views, StayAsTheyWereWhenAChangeIsRefused) {
    View shown = view();
    shown.edit({{"lights", {{"point", {{"position", {0.2, 1, 0}}}}}}});
    refine(shown, 2);
    const Image before = shown.picture();
    const json edits = shown.edits();
    EXPECT_THAT(error_of([&] {
                    shown.edit({{"lights", {{"moon", json::object()}}}});
                }),
                HasSubstr("no light of the name or index 'moon'"));
    EXPECT_THAT(error_of([&] { shown.edit({{"lights", 3}}); }), HasSubstr("reading edits"));
    EXPECT_THAT(error_of([&] {
                    shown.edit({{"nodes", {{"ghost", json::object()}}}});
                }),
                HasSubstr("no node"));
    EXPECT_THAT(error_of([&] { shown.open(asset("missing.glb")); }), HasSubstr("missing.glb"));
    EXPECT_THAT(error_of([&] { shown.set_method("magic"); }), HasSubstr("magic"));
    EXPECT_THAT(error_of([&] { shown.set_option("zoom", "3"); }), HasSubstr("no such option"));
    EXPECT_THAT(error_of([&] { shown.set_option("photons", "many"); }), HasSubstr("photons"));
    EXPECT_THAT(error_of([&] { shown.set_option("photons", "-1"); }), HasSubstr("between"));
    EXPECT_EQ(shown.edits(), edits);
    refine(shown, 3);
    EXPECT_EQ(shown.picture().pixels, rendered(shown).pixels);
    EXPECT_NE(shown.picture().pixels, before.pixels);
}

TEST_F(Views, SwitchMethodsSizesAndScenes) {
    View shown = view();
    for (const std::string& method : method_names()) {
        shown.set_method(method);
        if (method == "image-space") {
            shown.set_option("map-size", "16");
        }
        EXPECT_TRUE(shown.frame().moving) << method;
        EXPECT_EQ(shown.frame().passes, 1u) << method;
    }
    shown.set_method("photons");
    for (const auto& [width, height] : {std::pair(1, 1), std::pair(64, 1), std::pair(13, 31)}) {
        shown.resize(width, height);
        for (int i = 0; i < 2; ++i) {
            shown.frame();
            EXPECT_EQ(shown.picture().width, width);
            EXPECT_EQ(shown.picture().height, height);
        }
        EXPECT_EQ(shown.picture().pixels, rendered(shown).pixels);
    }
    shown.edit({{"lights", {{"point", {{"position", {0, 1, 0}}}}}}});
    shown.open(asset("spot.glb"));
    EXPECT_TRUE(shown.edits().empty());
    EXPECT_TRUE(shown.frame().moving);
    shown.frame();
    EXPECT_EQ(shown.picture().pixels, rendered(shown).pixels);
}

TEST_F(Views, MoveThroughTheTimeOfAnimations) {
    View shown = view("moving_light.glb");
    shown.frame();
    std::vector<glm::vec3> before = shown.picture().pixels;
    for (const std::optional<double> seconds : {std::optional(0.5), std::optional(1.0), {}}) {
        shown.set_time(seconds);
        EXPECT_TRUE(shown.frame().moving);
        EXPECT_NE(shown.picture().pixels, before);
        before = shown.picture().pixels;
        shown.frame();
        EXPECT_EQ(shown.picture().pixels, rendered(shown).pixels);
    }
}

TEST_F(Views, NeedNoMoreMemoryInTheLongRun) {
    View shown = view();
    const auto change = [&](int i) {
        shown.open(asset(i % 2 == 0 ? "cornell_point.glb" : "spot.glb"));
        shown.resize(16 + i % 3, 16);
        shown.edit({{"lights", {{"0", {{"position", {0.1 * (i % 5), 1, 0}}}}}}});
        shown.frame();
        shown.frame();
    };
    for (int i = 0; i < 12; ++i) {
        change(i);
    }
    const std::uint64_t settled = open().memory().current;
    for (int i = 0; i < 12; ++i) {
        change(i);
    }
    EXPECT_EQ(open().memory().current, settled);
}

TEST_F(Views, HaveTheBitsOfRenderWhenEditsOfNodesAreTakenBack) {
    View shown = view("smooth_sphere.glb");
    const std::string node = shown.scene().objects.at(0).name;
    shown.edit({{"nodes", {{node, {{"translation", {0, 0.1, 0}}}}}}});
    shown.frame();
    shown.edit({{"nodes", nullptr}});
    EXPECT_TRUE(shown.frame().moving);
    shown.frame();
    EXPECT_EQ(shown.picture().pixels, rendered(shown).pixels);
}

TEST_F(Views, HaveLayersAfterEveryChange) {
    View shown = view();
    refine(shown, 1);
    EXPECT_GT(shown.layers().size(), 1u);
    shown.set_method("knn");
    ASSERT_EQ(shown.layers().size(), 1u); // the picture that is still shown
    EXPECT_EQ(shown.layers()[0].image.pixels, shown.picture().pixels);
}

TEST_F(Views, GoBackWhereAChangeCannotBeRendered) {
    View shown = view();
    shown.edit({{"lights", {{"point", {{"position", {0.2, 1, 0}}}}}}});
    refine(shown, 2);
    const json edits = shown.edits();
    const std::vector<glm::vec3> before = shown.picture().pixels;
    shown.edit({{"nodes", {{"tall box", {{"scale", {3e38, 3e38, 3e38}}}}}}});
    EXPECT_THAT(error_of([&] { shown.frame(); }), HasSubstr("not finite"));
    EXPECT_EQ(shown.edits(), edits);
    EXPECT_TRUE(shown.frame().moving);
    refine(shown, 2);
    EXPECT_EQ(shown.picture().pixels, before);
}

TEST_F(Views, KeepTheirTimeWhereAnotherIsRefused) {
    View shown = view("moving_light.glb");
    shown.set_time(0.5);
    EXPECT_THAT(error_of([&] {
                    shown.edit({{"lights", {{"moon", json::object()}}}});
                }),
                HasSubstr("moon"));
    EXPECT_EQ(shown.time(), 0.5);
}

TEST_F(Views, LookFromTheFirstCameraOfAFileThatHasFewer) {
    const testing::ScratchDirectory directory;
    const std::string file = (directory / "scene.glb").string();
    std::filesystem::copy_file(asset("cornell_point.glb"), file);
    Scene scene = load(file, {}, false);
    scene.cameras.push_back(scene.cameras.front());
    ViewSettings second = settings();
    second.still.camera = 1;
    View shown(open(), std::move(scene), file, load, second);
    shown.frame();
    shown.open(file);
    EXPECT_EQ(shown.settings().camera, 0u);
    EXPECT_TRUE(shown.frame().moving);
}

TEST_F(Views, RefineOnlyAsFarAsAsked) {
    View shown = view();
    shown.set_option("passes", "2");
    shown.frame();
    EXPECT_EQ(shown.frame().passes, 1u);
    const ViewFrame last = shown.frame();
    EXPECT_EQ(last.passes, 2u);
    EXPECT_EQ(shown.frame().picture, last.picture);
    EXPECT_EQ(shown.picture().pixels, rendered(shown).pixels);
}

TEST_F(Views, AreGivenUpWhereTheUserActs) {
    View shown = view();
    shown.frame();
    const std::vector<glm::vec3> preview = shown.picture().pixels;
    EXPECT_EQ(shown.frame([] { return false; }).passes, 0u);
    EXPECT_EQ(shown.picture().pixels, preview);
    refine(shown, 2);
    EXPECT_EQ(shown.picture().pixels, rendered(shown).pixels);
}

class ViewScripts : public Views {
protected:
    std::vector<ViewFrame> frames_;
    std::vector<std::string> errors_, screenshots_;

    void run(View& shown, const json& script) {
        run_script(
            shown, parse_script(script, "script"),
            {.screenshot = [&](View&, const std::string& file) { screenshots_.push_back(file); },
             .on_frame =
                 [&](const ViewFrame& frame, const std::string& error) {
                     frames_.push_back(frame);
                     errors_.push_back(error);
                 },
             .stops = [] { return false; }});
    }
};

TEST_F(ViewScripts, RunInOrder) {
    View shown = view();
    run(shown, json::parse(R"({"frames": 8, "events": [
        {"frame": 3, "edits": {"lights": {"point": {"position": [0.3, 1, 0]}}},
         "expect": {"moving": true}, "screenshot": "a.png"},
        {"frame": 5, "expect": {"moving": false, "passes": 2}, "screenshot": "b.png"},
        {"frame": 6, "open": "/nowhere.glb", "expect": {"error": "/nowhere.glb", "passes": 3}}]})"));
    ASSERT_EQ(frames_.size(), 8u);
    const std::vector<bool> moving{true, false, false, true, false, false, false, false};
    for (std::size_t i = 0; i < frames_.size(); ++i) {
        EXPECT_EQ(frames_[i].number, i);
        EXPECT_EQ(frames_[i].moving, moving[i]) << i;
        EXPECT_EQ(errors_[i].empty(), i != 6) << errors_[i];
    }
    EXPECT_EQ(screenshots_, (std::vector<std::string>{"a.png", "b.png"}));
    EXPECT_EQ(shown.picture().pixels, rendered(shown).pixels);
}

TEST_F(ViewScripts, FailWhereWhatTheyExpectIsNotSo) {
    View shown = view();
    for (const auto& [event, message] : std::vector<std::pair<const char*, const char*>>{
             {R"({"frame": 1, "expect": {"moving": true}})", "shows the picture at rest, but"},
             {R"({"frame": 1, "expect": {"passes": 200}})", "the script expects 200"},
             {R"({"frame": 1, "expect": {"seconds": 0}})", "the script allows 0 s"},
             {R"({"frame": 1, "expect": {"error": "x"}})", "expects the error 'x'"},
             {R"({"frame": 1, "method": "magic"})", "at frame 1, "},
             {R"({"frame": 1, "method": "magic", "expect": {"error": "y"}})", "magic"}}) {
        const json script{{"frames", 3}, {"events", json::array({json::parse(event)})}};
        EXPECT_THAT(error_of([&] { run(shown, script); }), HasSubstr(message)) << event;
    }
}

} // namespace
} // namespace argand
