#include "image/pictures.hpp"
#include "image/png.hpp"
#include "image/srgb.hpp"
#include "support/expect_error.hpp"
#include "support/scratch_directory.hpp"
#include <cmath>
#include <limits>

using namespace argand;
using namespace argand::testing;
using ::testing::HasSubstr;

namespace {

std::string big_endian(std::uint32_t value) {
    return {static_cast<char>(value >> 24), static_cast<char>(value >> 16),
            static_cast<char>(value >> 8), static_cast<char>(value)};
}

std::string chunk(const std::string& type, const std::string& data) {
    const std::string body = type + data;
    std::uint32_t crc = 0xffffffff;
    for (const char c : body) {
        crc ^= static_cast<std::uint8_t>(c);
        for (int bit = 0; bit < 8; ++bit) {
            crc = (crc >> 1) ^ ((crc & 1) != 0 ? 0xedb88320 : 0);
        }
    }
    return big_endian(static_cast<std::uint32_t>(data.size())) + body + big_endian(~crc);
}

/// Builds a PNG from rows that are stored without compression. Each row begins with the byte that
/// names its filter.
std::string png(std::uint32_t width, std::uint32_t height, int depth, int color_type,
                const std::string& rows) {
    std::uint32_t a = 1, b = 0;
    for (const char c : rows) {
        a = (a + static_cast<std::uint8_t>(c)) % 65521;
        b = (b + a) % 65521;
    }
    const auto size = static_cast<std::uint16_t>(rows.size());
    const std::string zlib = std::string("\x78\x01\x01", 3) + static_cast<char>(size & 0xff) +
                             static_cast<char>(size >> 8) + static_cast<char>(~size & 0xff) +
                             static_cast<char>((~size >> 8) & 0xff) + rows +
                             big_endian(b << 16 | a);
    return "\x89PNG\r\n\x1a\n" +
           chunk("IHDR", big_endian(width) + big_endian(height) + static_cast<char>(depth) +
                             static_cast<char>(color_type) + std::string(3, '\0')) +
           chunk("IDAT", zlib) + chunk("IEND", "");
}

Image read_back(const Image& image, float exposure = 0) {
    const ScratchDirectory scratch;
    write_png(scratch / "a.png", image, {.display = {.exposure_ev = exposure}});
    return read_png(scratch / "a.png");
}

/// The 8-bit code that `write_png` stores for a linear value, recovered with `read_png`.
int code_of(float linear, float exposure = 0) {
    const float decoded = read_back(constant(1, 1, glm::vec3(linear)), exposure).pixels[0].r;
    return static_cast<int>(std::lround(255 * srgb_encode(decoded)));
}

TEST(Png, EveryCodeSurvives) {
    Image image{16, 16, {}};
    for (int i = 0; i < 256; ++i) {
        const auto value = static_cast<float>(srgb_decode(i / 255.0));
        image.pixels.emplace_back(value, static_cast<float>(srgb_decode((255 - i) / 255.0)), 0);
    }
    const Image read = read_back(image);
    EXPECT_EQ(read.width, 16);
    EXPECT_EQ(read.height, 16);
    EXPECT_EQ(read.pixels, image.pixels);
}

TEST(Png, FollowsTheStandardsCurve) {
    // Values of IEC 61966-2-1, computed by hand: 0.18 → 0.4613561 · 255 = 117.6, 0.5 → 187.5
    // (rounds to 188), the joint of line and curve 0.0031308 → 10.3.
    EXPECT_EQ(code_of(0.18f), 118);
    EXPECT_EQ(code_of(0.5f), 188);
    EXPECT_EQ(code_of(0.0031308f), 10);
    EXPECT_EQ(code_of(0), 0);
    EXPECT_EQ(code_of(1), 255);
}

TEST(Png, RoundsToNearest) {
    for (const int code : {0, 1, 7, 100, 200, 254}) {
        const double border = srgb_decode((code + 0.5) / 255);
        EXPECT_EQ(code_of(static_cast<float>(border * (1 - 1e-4))), code);
        EXPECT_EQ(code_of(static_cast<float>(border * (1 + 1e-4))), code + 1);
    }
}

TEST(Png, ExposureScalesByPowersOfTwo) {
    EXPECT_EQ(code_of(0.09f, 1), code_of(0.18f));
    EXPECT_EQ(code_of(0.36f, -1), code_of(0.18f));
    EXPECT_EQ(code_of(0.18f, 0.5f), code_of(0.18f * std::sqrt(2.0f)));
    EXPECT_EQ(code_of(1e-30f, 99), code_of(std::ldexp(1e-30f, 99)));
    EXPECT_EQ(code_of(0.5f, 100), 255);
    EXPECT_EQ(code_of(0.5f, -100), 0);
    EXPECT_EQ(code_of(0, std::numeric_limits<float>::infinity()), 0);
}

TEST(Png, ClampsValuesOutsideTheRange) {
    using Limits = std::numeric_limits<float>;
    EXPECT_EQ(code_of(-1), 0);
    EXPECT_EQ(code_of(7), 255);
    EXPECT_EQ(code_of(Limits::max()), 255);
    EXPECT_EQ(code_of(Limits::infinity()), 255);
    EXPECT_EQ(code_of(-Limits::infinity()), 0);
    EXPECT_EQ(code_of(Limits::quiet_NaN()), 0);
    EXPECT_EQ(code_of(Limits::denorm_min()), 0);
}

TEST(Png, KeepsRowsAndColumnsInPlace) {
    for (const auto& [width, height] : {std::pair{1, 1}, {1, 9}, {9, 1}, {7, 5}, {129, 67}}) {
        Image image = constant(width, height, glm::vec3(0));
        image.pixels.back() = {1, 0, 0};
        image.pixels.front() = {0, 0, 1};
        const Image read = read_back(image);
        EXPECT_EQ(read.width, width);
        EXPECT_EQ(read.height, height);
        EXPECT_EQ(read.pixels, image.pixels);
    }
}

TEST(Png, ReadsOtherKindsOfPng) {
    const ScratchDirectory scratch;
    const auto read = [&](const std::string& bytes) {
        write_text(scratch / "a.png", bytes);
        return read_png(scratch / "a.png").pixels;
    };
    const auto linear = [](double code) { return static_cast<float>(srgb_decode(code)); };
    // 16 bits grey, RGB with alpha, 1 bit grey.
    EXPECT_EQ(read(png(1, 1, 16, 0, std::string("\0\x80\x01", 3)))[0],
              glm::vec3(linear(0x8001 / 65535.0)));
    EXPECT_EQ(read(png(1, 1, 8, 6, std::string("\0\xff\x80\0\x10", 5)))[0],
              glm::vec3(1, linear(128 / 255.0), 0));
    EXPECT_EQ(read(png(2, 1, 1, 0, std::string("\0\x40", 2))),
              (std::vector<glm::vec3>{glm::vec3(0), glm::vec3(1)}));
}

TEST(Png, RefusesEmptyImagesAndUnwritablePaths) {
    const ScratchDirectory scratch;
    EXPECT_THAT(error_of([&] { write_png(scratch / "a.png", {}); }), HasSubstr("0 × 0"));
    EXPECT_THAT(error_of([&] {
                    write_png(scratch / "a.png", Image{1, 2, {{}}});
                }),
                HasSubstr("1 pixels"));
    EXPECT_TRUE(scratch.names().empty());
    std::filesystem::create_directory(scratch / "folder.png");
    EXPECT_THAT(error_of([&] { write_png(scratch / "folder.png", noise(1, 1, 1)); }),
                HasSubstr("directory"));
    EXPECT_THAT(error_of([&] { write_png(scratch / "none/a.png", noise(1, 1, 1)); }),
                HasSubstr("does not exist"));
}

TEST(PngHostile, NamesTheProblem) {
    const ScratchDirectory scratch;
    const auto error = [&](const std::string& bytes) {
        write_text(scratch / "bad.png", bytes);
        const std::string message = error_of([&] { read_png(scratch / "bad.png"); });
        EXPECT_THAT(message, HasSubstr("bad.png"));
        return message;
    };
    EXPECT_THAT(error(""), HasSubstr("empty"));
    EXPECT_THAT(error("GIF89a.................."), HasSubstr("not a PNG"));
    EXPECT_THAT(error("#?RADIANCE\n\n-Y 1 +X 1\n1234"), HasSubstr("not a PNG"));
    EXPECT_THAT(error(png(0, 1, 8, 0, "")), HasSubstr("damaged"));
    EXPECT_THAT(error(png(0x7fffffff, 0x7fffffff, 8, 2, "x")), HasSubstr("damaged"));
    EXPECT_THAT(error(png(60000, 60000, 8, 2, "x")), HasSubstr("damaged"));
    EXPECT_THAT(error(png(2, 2, 8, 2, "x")), HasSubstr("damaged"));
    EXPECT_THAT(error_of([&] { read_png(scratch / "none.png"); }), HasSubstr("no such file"));
    EXPECT_THAT(error_of([&] { read_png(scratch.path()); }), HasSubstr("directory"));
}

TEST(Png, SaysHowItWasMade) {
    const ScratchDirectory scratch;
    const std::string command = "argand render 'a ü.glb' --tone neutral";
    const Image image = noise(13, 9, 3);
    write_png(scratch / "plain.png", image);
    write_png(scratch / "a.png", image, {.display = {}, .window = {}, .command = command});
    const std::string plain = read_text(scratch / "plain.png"),
                      bytes = read_text(scratch / "a.png");
    const std::string comment = chunk("iTXt", std::string("Comment\0\0\0\0\0", 12) + command);
    constexpr std::size_t behind_header = 33;
    EXPECT_EQ(bytes, plain.substr(0, behind_header) + comment + plain.substr(behind_header));
    EXPECT_EQ(read_png(scratch / "a.png").pixels, read_png(scratch / "plain.png").pixels);
}

TEST(PngHostile, SurvivesTruncationAndDamage) {
    const ScratchDirectory scratch;
    write_png(scratch / "whole.png", noise(13, 9, 3));
    const std::string whole = read_text(scratch / "whole.png");
    const auto expect_picture_or_error = [&](const std::string& bytes) {
        write_text(scratch / "bad.png", bytes);
        try {
            const Image image = read_png(scratch / "bad.png");
            EXPECT_EQ(image.pixels.size(), static_cast<std::size_t>(image.width) *
                                               static_cast<std::size_t>(image.height));
        } catch (const Error& error) {
            EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos);
        }
    };
    for (std::size_t size = 0; size < whole.size(); ++size) {
        expect_picture_or_error(whole.substr(0, size));
    }
    for (std::size_t place = 0; place < whole.size(); ++place) {
        for (const char value : {'\0', '\x01', '\x7f', '\xff'}) {
            // stb refuses a width of billions of pixels, but 65536² pixels would take too much
            // memory for a test.
            if (place >= 16 && place < 24 && value != '\0') {
                continue;
            }
            std::string damaged = whole;
            damaged[place] = value;
            expect_picture_or_error(damaged);
        }
    }
}

TEST(Hdr, ReadsSharedExponents) {
    const ScratchDirectory scratch;
    // Two pixels of (128, 64, 0) · 2^(e − 136): e = 129 gives (1, 0.5, 0), e = 139 1024 times that.
    write_text(scratch / "a.hdr", std::string("#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 1 +X 2\n") +
                                      std::string("\x80\x40\0\x81\x80\x40\0\x8b", 8));
    const Image image = read_hdr(scratch / "a.hdr");
    ASSERT_EQ(image.pixels.size(), 2u);
    EXPECT_EQ(image.pixels[0], glm::vec3(1, 0.5f, 0));
    EXPECT_EQ(image.pixels[1], glm::vec3(1024, 512, 0));
}

TEST(Hdr, NamesTheProblem) {
    const ScratchDirectory scratch;
    const auto error = [&](const std::string& bytes) {
        write_text(scratch / "bad.hdr", bytes);
        return error_of([&] { read_hdr(scratch / "bad.hdr"); });
    };
    EXPECT_THAT(error(""), HasSubstr("empty"));
    EXPECT_THAT(error("nothing"), HasSubstr("not a Radiance HDR"));
    EXPECT_THAT(error("#?RADIANCE\nFORMAT=strange\n\n-Y 1 +X 2\n"), HasSubstr("damaged"));
    EXPECT_THAT(error("#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 99999999 +X 99999999\n"),
                HasSubstr("99999999 × 99999999 pixels is not one that can be read"));
}

} // namespace
