#include "image/files.hpp"
#include "image/pictures.hpp"
#include "support/expect_error.hpp"
#include "support/scratch_directory.hpp"

using namespace argand;
using namespace argand::testing;
using ::testing::AllOf;
using ::testing::HasSubstr;

namespace {

TEST(ImageFiles, ChoosesTheFormatByExtension) {
    const ScratchDirectory scratch;
    const Layer layers[] = {{"direct", constant(3, 2, {1, 0, 0})},
                            {"", constant(3, 2, {0, 0.25f, 0})}};
    write_image(scratch / "a.EXR", layers, {.display = {.exposure_ev = 3}});
    const std::vector<Layer> exr = read_image(scratch / "a.EXR");
    ASSERT_EQ(exr.size(), 2u);
    EXPECT_EQ(exr[0].image.pixels[0], glm::vec3(0, 0.25f, 0)) << "an .exr takes no exposure";
    EXPECT_EQ(find_layer(exr, "direct")->pixels[5], glm::vec3(1, 0, 0));
    EXPECT_EQ(find_layer(exr, "other"), nullptr);

    write_image(scratch / "a.png", layers, {.display = {.exposure_ev = 2}});
    const std::vector<Layer> png = read_image(scratch / "a.png");
    ASSERT_EQ(png.size(), 1u);
    EXPECT_EQ(png[0].name, "");
    EXPECT_EQ(png[0].image.pixels[0], glm::vec3(0, 1, 0))
        << "the whole picture, after the exposure";

    write_image(scratch / "b.png", std::span(layers).first(1));
    EXPECT_EQ(read_image(scratch / "b.png")[0].image.pixels[0], glm::vec3(1, 0, 0));
    EXPECT_THAT(error_of([&] { write_image(scratch / "c.png", {}); }), HasSubstr("no picture"));

    write_text(scratch / "a.hdr",
               std::string("#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 1 +X 1\n\x80\x80\x80\x81"));
    EXPECT_EQ(read_image(scratch / "a.hdr")[0].image.pixels[0], glm::vec3(1));
}

TEST(ImageFiles, UnknownExtensionsAreUsageErrors) {
    const Layer layers[] = {{"", noise(1, 1, 1)}};
    for (const char* name : {"a.jpg", "a", "exr", ".png", "a.png.", "a.hdr"}) {
        EXPECT_THROW(write_image(name, layers), UsageError) << name;
        EXPECT_THROW(check_image_writable(name), UsageError) << name;
    }
    EXPECT_THROW(read_image("a.jpg"), UsageError);
    EXPECT_THAT(error_of([&] { write_image("a.jpg", layers); }),
                AllOf(HasSubstr("'.jpg'"), HasSubstr(".exr or .png")));
    EXPECT_THAT(error_of([&] { read_image("a.jpg"); }), HasSubstr(".exr, .png or .hdr"));
}

TEST(ImageFiles, CanBeCheckedBeforehand) {
    const ScratchDirectory scratch;
    check_image_writable(scratch / "a.png");
    check_image_writable(scratch / "a.exr");
    EXPECT_TRUE(scratch.names().empty());
    EXPECT_THAT(error_of([&] { check_image_writable(scratch / "none/a.png"); }),
                HasSubstr("does not exist"));
}

} // namespace
