#include "base/error.hpp"
#include "image/exr.hpp"
#include "support/scratch_directory.hpp"
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <gtest/gtest.h>
#include <tinyexr.h>

using namespace argand;
using namespace argand::testing;

namespace {

struct Kind {
    const char* name;
    int compression;
    int type;
};

constexpr int width = 29,
              height = 71; // more than one chunk of every compression, the last one short

/// Channel B is even, so that it shrinks; R and G are not.
float sample(int channel, int i) {
    return channel == 0 ? 0.5f : static_cast<float>((i * 7919 + channel * 13) % 1024) / 64;
}

/// A file as tinyexr writes it, with channels B, G, R.
std::string encoded(const Kind& kind) {
    std::array<std::vector<float>, 3> planes;
    std::array<unsigned char*, 3> samples{};
    std::array<EXRChannelInfo, 3> channels{};
    std::array<int, 3> stored{}, wanted{};
    for (std::size_t c = 0; c < 3; ++c) {
        for (int i = 0; i < width * height; ++i) {
            planes[c].push_back(sample(static_cast<int>(c), i));
        }
        samples[c] = reinterpret_cast<unsigned char*>(planes[c].data());
        channels[c].name[0] = "BGR"[c];
        stored[c] = TINYEXR_PIXELTYPE_FLOAT;
        wanted[c] = kind.type;
    }
    EXRHeader header;
    InitEXRHeader(&header);
    header.num_channels = 3;
    header.channels = channels.data();
    header.pixel_types = stored.data();
    header.requested_pixel_types = wanted.data();
    header.compression_type = kind.compression;
    EXRImage picture;
    InitEXRImage(&picture);
    picture.width = width;
    picture.height = height;
    picture.num_channels = 3;
    picture.images = samples.data();
    unsigned char* memory = nullptr;
    const char* message = nullptr;
    const std::size_t size = SaveEXRImageToMemory(&picture, &header, &memory, &message);
    std::string bytes(reinterpret_cast<const char*>(memory), size);
    std::free(memory);
    return bytes;
}

class ExrCompression : public ::testing::TestWithParam<Kind> {};

TEST_P(ExrCompression, IsRead) {
    const ScratchDirectory scratch;
    write_text(scratch / "a.exr", encoded(GetParam()));
    const std::vector<Layer> layers = read_exr(scratch / "a.exr");
    ASSERT_EQ(layers.size(), 1u);
    const Image& image = layers[0].image;
    ASSERT_EQ(image.width, width);
    ASSERT_EQ(image.height, height);
    for (int i = 0; i < width * height; ++i) {
        // All are multiples of 1/64 below 16, which a half holds exactly.
        ASSERT_EQ(image.pixels[static_cast<std::size_t>(i)],
                  glm::vec3(sample(2, i), sample(1, i), sample(0, i)))
            << "pixel " << i;
    }
}

TEST_P(ExrCompression, SurvivesDamage) {
    const ScratchDirectory scratch;
    const std::string whole = encoded(GetParam());
    std::uint32_t state = 1;
    const auto random = [&](std::size_t below) {
        state = state * 1664525u + 1013904223u;
        return static_cast<std::size_t>((std::uint64_t{state} * below) >> 32);
    };
    int read = 0, refused = 0;
    for (int round = 0; round < 400; ++round) {
        std::string damaged = whole;
        for (std::size_t left = 1 + random(6); left > 0; --left) {
            const std::size_t place = random(damaged.size());
            const std::size_t end = std::min(place + 1 + random(8), damaged.size());
            for (std::size_t i = place; i < end; ++i) {
                damaged[i] = static_cast<char>(random(256));
            }
        }
        write_text(scratch / "a.exr", damaged);
        try {
            read_exr(scratch / "a.exr");
            ++read;
        } catch (const Error& error) {
            EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos) << error.what();
            ++refused;
        }
    }
    EXPECT_EQ(read + refused, 400);
    EXPECT_GT(refused, 0);
}

INSTANTIATE_TEST_SUITE_P(
    Kinds, ExrCompression,
    ::testing::Values(Kind{"NoneFloat", TINYEXR_COMPRESSIONTYPE_NONE, TINYEXR_PIXELTYPE_FLOAT},
                      Kind{"NoneHalf", TINYEXR_COMPRESSIONTYPE_NONE, TINYEXR_PIXELTYPE_HALF},
                      Kind{"RleFloat", TINYEXR_COMPRESSIONTYPE_RLE, TINYEXR_PIXELTYPE_FLOAT},
                      Kind{"RleHalf", TINYEXR_COMPRESSIONTYPE_RLE, TINYEXR_PIXELTYPE_HALF},
                      Kind{"ZipsFloat", TINYEXR_COMPRESSIONTYPE_ZIPS, TINYEXR_PIXELTYPE_FLOAT},
                      Kind{"ZipsHalf", TINYEXR_COMPRESSIONTYPE_ZIPS, TINYEXR_PIXELTYPE_HALF},
                      Kind{"ZipFloat", TINYEXR_COMPRESSIONTYPE_ZIP, TINYEXR_PIXELTYPE_FLOAT},
                      Kind{"ZipHalf", TINYEXR_COMPRESSIONTYPE_ZIP, TINYEXR_PIXELTYPE_HALF},
                      Kind{"PizFloat", TINYEXR_COMPRESSIONTYPE_PIZ, TINYEXR_PIXELTYPE_FLOAT},
                      Kind{"PizHalf", TINYEXR_COMPRESSIONTYPE_PIZ, TINYEXR_PIXELTYPE_HALF}),
    [](const auto& instance) { return instance.param.name; });

} // namespace
