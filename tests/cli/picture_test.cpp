// How pictures are written: curve, exposure, crop, further layers, and what made them.
#include "argand_run.hpp"

#include "image/png.hpp"

#include <cmath>

namespace argand::testing {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

class Pictures : public ArgandTest {
protected:
    static std::string render() {
        return "render '" + asset("cornell_point.glb") + "' --method path --size 8x6 --spp 4 -q ";
    }

    void expect_success(const std::string& arguments) const {
        const Outcome run = argand(arguments, on_host);
        EXPECT_EQ(run.exit_code, 0) << run.error;
    }

    nlohmann::json report(const std::string& name) const {
        return nlohmann::json::parse(read_text(file(name)));
    }
};

TEST_F(Pictures, CurveAndExposureAreThoseOfThePng) {
    expect_success(render() + "-o a.exr -o a.png --json a.json");
    expect_success(render() + "-o b.exr -o b.png --tone neutral --exposure auto --json b.json");
    EXPECT_EQ(pixels("a.exr"), pixels("b.exr"));
    EXPECT_EQ(report("a.json").at("parameters").at("tone"), "linear");
    const nlohmann::json parameters = report("b.json").at("parameters");
    EXPECT_EQ(parameters.at("tone"), "neutral");
    const Image linear = whole_picture(read_image(file("a.exr")));
    const auto stops = static_cast<float>(automatic_exposure(linear));
    EXPECT_EQ(parameters.at("exposure").get<float>(), stops);
    EXPECT_EQ(srgb_bytes(read_png(file("b.png")), {}),
              srgb_bytes(linear, {.exposure_ev = stops, .tone = Tone::neutral}));
    EXPECT_EQ(srgb_bytes(read_png(file("a.png")), {}), srgb_bytes(linear, {}));
}

TEST_F(Pictures, AutomaticExposureIsTold) {
    const Outcome run = argand("render '" + asset("cornell_point.glb") +
                                   "' --method path --size 4x4 --spp 1 --exposure auto -o a.png",
                               on_host);
    EXPECT_THAT(run.error, HasSubstr("note: --exposure auto is "));
}

TEST_F(Pictures, FilesSayWhichCommandMadeThem) {
    expect_success(render() + "-o 'a b.png' -o a.exr --tone filmic");
    const std::string command = "argand render '" + asset("cornell_point.glb") +
                                "' --method path --size 8x6 --spp 4 -q -o 'a b.png' -o a.exr "
                                "--tone filmic";
    // The asset's path needs no quotes unless it has odd characters.
    const std::string tail = command.substr(command.find(" --method"));
    for (const char* name : {"a b.png", "a.exr"}) {
        EXPECT_THAT(read_text(file(name)), HasSubstr(tail)) << name;
        EXPECT_THAT(read_text(file(name)), HasSubstr("argand render ")) << name;
    }
}

TEST_F(Pictures, ACropIsAPartOfThePicture) {
    expect_success(render() + "-o whole.exr");
    expect_success(render() + "-o part.exr -o part.png --crop 2,1,7,5 --json part.json");
    const Image whole = whole_picture(read_image(file("whole.exr")));
    const Image part = whole_picture(read_image(file("part.exr")));
    ASSERT_EQ(part.width, 5);
    ASSERT_EQ(part.height, 4);
    for (int y = 0; y < 4; ++y) {
        for (int x = 0; x < 5; ++x) {
            EXPECT_EQ(part.pixels[static_cast<std::size_t>(5 * y + x)],
                      whole.pixels[static_cast<std::size_t>(8 * (y + 1) + x + 2)]);
        }
    }
    EXPECT_EQ(read_png(file("part.png")).width, 5);
    EXPECT_THAT(report("part.json").at("parameters").at("crop"), ElementsAre(2, 1, 7, 5));
}

TEST_F(Pictures, FurtherLayersAreThoseAskedFor) {
    expect_success(render() + "-o a.exr --aovs depth,id --json a.json");
    expect_success(render() + "-o b.exr --aovs albedo,normal,variance");
    expect_success(render() + "-o plain.exr");
    const std::vector<Layer> a = read_image(file("a.exr")), b = read_image(file("b.exr"));
    const auto names = [](const std::vector<Layer>& layers) {
        std::vector<std::string> all;
        for (const Layer& layer : layers) {
            all.push_back(layer.name);
        }
        return all;
    };
    EXPECT_THAT(names(a), ElementsAre("", "caustic", "depth", "direct", "id", "indirect"));
    EXPECT_THAT(names(b),
                ElementsAre("", "albedo", "caustic", "direct", "indirect", "normal", "variance"));
    const std::vector<Layer> plain = read_image(file("plain.exr"));
    for (const std::vector<Layer>* layers : {&a, &b}) {
        EXPECT_EQ(whole_picture(*layers).pixels, whole_picture(plain).pixels);
    }
    bool varies = false;
    for (const glm::vec3& pixel : find_layer(b, "variance")->pixels) {
        varies = varies || pixel.g > 0;
        EXPECT_TRUE(std::isfinite(pixel.g) && pixel.g >= 0);
    }
    EXPECT_TRUE(varies);
    // Every object in the picture is one that the report names.
    std::vector<float> ids;
    for (const nlohmann::json& object : report("a.json").at("objects")) {
        ids.push_back(object.at("id").get<float>());
    }
    for (const glm::vec3& pixel : find_layer(a, "id")->pixels) {
        EXPECT_TRUE(pixel.x == 0 || std::count(ids.begin(), ids.end(), pixel.x) == 1) << pixel.x;
    }
}

TEST_F(Pictures, RequestsThatMakeNoSense) {
    const std::string scene = "render '" + asset("cornell_point.glb") + "' --size 8x6 ";
    for (const char* crop : {"0,0,0,1", "0,0,9,6", "0,0,8,7", "-1,0,4,4", "3,3,2,4", "1,2,3", "a",
                             "1,2,3,4,5", "1,2,3,4x", "''", "1.5,0,2,2", "1,,3,4"}) {
        expect_failure(scene + "--crop " + crop, usage, "--crop");
    }
    expect_failure(scene + "--tone vivid", usage, "--tone");
    expect_failure(scene + "--tone filmic -o a.exr", usage, "no effect on .exr files");
    expect_failure(scene + "--exposure 1 -o a.exr -o b.exr", usage, "--exposure");
    expect_failure(scene + "--filter gauss", usage, "--filter");
    expect_failure(scene + "-o a.exr --aovs beauty", usage, "--aovs");
    expect_failure(scene + "-o a.exr --aovs depth,beauty", usage, "--aovs");
    expect_failure(scene + "-o a.png --aovs depth", usage, "add -o FILE.exr");
    const std::string variance = scene + "-o a.exr --aovs variance ";
    expect_failure(variance + "--method path --spp 1", usage, "--spp 2 or more");
    expect_failure(variance + "--target-error 0.1", usage, "passes that are known");
    expect_failure(variance + "--checkpoint a.ckpt", usage, "do not save it");
    expect_failure(scene + "--exposure auto --frames 0:2 -o a%d.png", usage, "flicker");
}

} // namespace
} // namespace argand::testing
