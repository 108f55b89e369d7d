// --env and --sun: what they accept, and that they are part of a picture and of what is kept of it.
#include "argand_run.hpp"

#include "image/files.hpp"

#include <filesystem>
#include <fmt/format.h>
#include <limits>

namespace argand::testing {
namespace {

class SkyOptions : public ArgandTest {
protected:
    std::string on_scene(const std::string& command) const {
        return command + " '" + asset("plane_point.gltf") + "' ";
    }

    void write_exr_sky(const std::string& name, int width, int height, glm::vec3 odd_one,
                       std::size_t at = 1) const {
        Image image{width, height, {}};
        image.pixels.resize(static_cast<std::size_t>(width) * static_cast<std::size_t>(height),
                            glm::vec3(1));
        image.pixels[std::min(at, image.pixels.size() - 1)] = odd_one;
        const std::vector<Layer> layers = {{"", std::move(image)}};
        write_image(file(name), layers);
    }

    /// A Radiance file without run lengths.
    static std::string hdr(int width, int height, const std::string& pixels) {
        return fmt::format("#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y {} +X {}\n", height, width) +
               pixels;
    }

    static std::string same_pixels(std::size_t count, const std::string& rgbe) {
        std::string pixels;
        for (std::size_t i = 0; i < count; ++i) {
            pixels += rgbe;
        }
        return pixels;
    }
};

TEST_F(SkyOptions, BadValuesAreUsageErrors) {
    const std::string render = on_scene("render") + "--size 8x8 ";
    for (const char* env : {"1,1", "1,1,1,1", "-1,1,1", "1,x,1", "nan,1,1", "inf,1,1", "1,1,1e31",
                            "sky.png", "sky", ",,", "1, 1,1"}) {
        expect_failure(render + "--env '" + env + "'", usage, "--env");
    }
    for (const char* sun : {"30", "91,0", "-91,0", "nan,0", "30,nan", "30,0,0.5", "30,0,11",
                            "30,0,2,1", "high,0", "30,1e9"}) {
        expect_failure(render + "--sun " + sun, usage, "--sun");
    }
    expect_failure(render + "--env 1,1,1 --sun 30,0", usage, "leave one of them out");
    expect_failure(render + "--env-rotation 30", usage, "--env-rotation");
    expect_failure(render + "--env-strength 2", usage, "--env-strength");
    expect_failure(render + "--env 1,1,1 --env-rotation nan", usage, "--env-rotation");
    expect_failure(render + "--env 1,1,1 --env-strength -1", usage, "--env-strength");
    expect_failure(render + "--env 1,1,1 --env-strength inf", usage, "--env-strength");
}

TEST_F(SkyOptions, BadPicturesAreErrorsOfOneLine) {
    const std::string render = on_scene("render") + "--size 8x8 --env ";
    const float infinity = std::numeric_limits<float>::infinity();
    expect_failure(render + "missing.hdr", failure, "missing.hdr");
    write_exr_sky("infinite.exr", 4, 2, {1, infinity, 1});
    expect_failure(render + "infinite.exr", failure, "column 1 of row 0");
    write_exr_sky("nan.exr", 4, 2, {1, 1, std::numeric_limits<float>::quiet_NaN()}, 6);
    expect_failure(render + "nan.exr", failure, "column 2 of row 1");
    write_exr_sky("negative.exr", 4, 2, {-0.5f, 1, 1});
    expect_failure(render + "negative.exr", failure, "is negative");
    write_text(file("not.exr"), "no picture");
    expect_failure(render + "not.exr", failure, "not.exr");
    write_text(file("not.hdr"), "no picture");
    expect_failure(render + "not.hdr", failure, "not.hdr");
    write_text(file("empty.hdr"), "");
    expect_failure(render + "empty.hdr", failure, "empty");
    const std::string grey = "\x80\x80\x80\x81";
    write_text(file("short.hdr"), hdr(4, 2, same_pixels(7, grey)));
    expect_failure(render + "short.hdr", failure, "cut short");
    write_text(file("large.hdr"), hdr(60000, 60000, same_pixels(7, grey)));
    expect_failure(render + "large.hdr", failure, "60000 × 60000");
    write_text(file("wide.hdr"), hdr(16384, 8192, same_pixels(7, grey)));
    expect_failure(render + "wide.hdr", failure, "cut short");
    write_text(file("none.hdr"), hdr(0, 0, ""));
    expect_failure(render + "none.hdr", failure, "none.hdr");
    write_text(file("bright.hdr"), hdr(4, 2, same_pixels(8, "\xff\xff\xff\xff")));
    expect_failure(render + "bright.hdr", failure, "brighter than 1e30");
    const std::string whole = [&] {
        write_exr_sky("whole.exr", 64, 32, glm::vec3(2));
        return read_text(file("whole.exr"));
    }();
    write_text(file("short.exr"), whole.substr(0, whole.size() / 2));
    expect_failure(render + "short.exr", failure, "short.exr");
    write_text(file("good.hdr"), hdr(4, 2, same_pixels(8, grey)));
    expect_failure(render + "good.hdr -o good.hdr", usage, "good.hdr");
    expect_failure(render + "whole.exr -o whole.exr", usage, "whole.exr");
}

TEST_F(SkyOptions, AreInThePictureAndItsKeepers) {
    write_exr_sky("sky.exr", 8, 4, {9, 3, 1}, 9);
    const std::string render = on_scene("render") + "--size 8x8 --spp 2 --quiet ";
    std::vector<std::string> skies = {"",
                                      "--env 1,1,1",
                                      "--env 1,1,1 --env-strength 2",
                                      "--env sky.exr",
                                      "--env sky.exr --env-rotation 90",
                                      "--env sky.exr --env-strength 3",
                                      "--sun 30,90"};
    std::vector<std::string> seen;
    for (const std::string& sky : skies) {
        const Outcome run =
            argand(render + sky + " --method path -o picture.exr --checkpoint kept.ckpt", on_host);
        ASSERT_EQ(run.exit_code, 0) << sky << ": " << run.error;
        const std::string picture = read_text(file("picture.exr"));
        EXPECT_EQ(std::count(seen.begin(), seen.end(), picture), 0) << sky;
        seen.push_back(picture);
        if (sky != skies.back()) {
            std::filesystem::remove(file("kept.ckpt"));
        }
    }
    // The checkpoint is that of the last sky.
    expect_failure(render + "--env sky.exr --method path -o picture.exr --checkpoint kept.ckpt "
                            "--resume kept.ckpt",
                   failure, "kept.ckpt", on_host);
}

TEST_F(SkyOptions, InspectShowsTheSky) {
    write_exr_sky("sky.exr", 8, 4, {9, 3, 1}, 9);
    const Outcome text = argand(on_scene("inspect") + "--env sky.exr");
    EXPECT_THAT(text.out, ::testing::HasSubstr("sky         sky.exr, 8 × 4 texels"));
    EXPECT_THAT(text.out, ::testing::HasSubstr("picture of the sky: the sky"));
    const Outcome run = argand(on_scene("inspect") + "--sun 35,120 --env-rotation 20 --json");
    ASSERT_EQ(run.exit_code, 0) << run.error;
    const nlohmann::json sun = nlohmann::json::parse(run.out)["environment"]["sun"];
    EXPECT_NEAR(sun["elevation"].get<double>(), 35, 1e-3);
    EXPECT_NEAR(sun["azimuth"].get<double>(), 100, 1e-3); // counter-clockwise from above
}

} // namespace
} // namespace argand::testing
