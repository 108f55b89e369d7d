#include "base/error.hpp"
#include "image/exr.hpp"
#include "image/pictures.hpp"
#include "support/expect_error.hpp"
#include "support/scratch_directory.hpp"
#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfIO.h>
#include <ImfInputFile.h>
#include <ImfOutputFile.h>
#include <ImfTiledOutputFile.h>
#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <gtest/gtest.h>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

using namespace argand;
using namespace argand::testing;
using ::testing::HasSubstr;

namespace {

// These tests read files that the C++ library of OpenEXR wrote, with every compression, sample
// type and storage. Argand itself uses the C library, whose codecs are another implementation.

struct Kind {
    const char* name;
    Imf::Compression compression;
    Imf::PixelType type;
    bool tiled = false;
};

// More than one chunk of every compression and several tiles, the last ones incomplete.
constexpr int width = 45, height = 261;
constexpr int left = -3, top = 20; // where the data window begins

/// Whole numbers below 1024, which all sample types hold exactly. Channel B is even, so that it
/// shrinks; G and R are not.
float sample(int channel, int i) {
    return channel == 0 ? 7.0f : static_cast<float>((i * 7919 + channel * 13) % 1024);
}

/// Collects the bytes of a file in memory.
class Output : public Imf::OStream {
public:
    Output() : Imf::OStream("memory") {}
    void write(const char bytes[], int count) override {
        const auto size = static_cast<std::size_t>(count);
        text.resize(std::max(text.size(), place_ + size));
        std::memcpy(text.data() + place_, bytes, size);
        place_ += size;
    }
    std::uint64_t tellp() override { return place_; }
    void seekp(std::uint64_t place) override { place_ = place; }

    std::string text;

private:
    std::size_t place_ = 0;
};

/// The bytes of a file with the channels B, G and R.
std::string encoded(const Kind& kind) {
    const Imath::Box2i window({left, top}, {left + width - 1, top + height - 1});
    Imf::Header header(Imath::Box2i({0, 0}, {99, 399}), window);
    header.compression() = kind.compression;
    std::array<std::vector<float>, 3> floats;
    std::array<std::vector<half>, 3> halves;
    std::array<std::vector<std::uint32_t>, 3> integers;
    Imf::FrameBuffer frame;
    for (std::size_t c = 0; c < 3; ++c) {
        for (int i = 0; i < width * height; ++i) {
            const float value = sample(static_cast<int>(c), i);
            floats[c].push_back(value);
            halves[c].emplace_back(value);
            integers[c].push_back(static_cast<std::uint32_t>(value));
        }
        const std::string name(1, "BGR"[c]);
        header.channels().insert(name, Imf::Channel(kind.type));
        const void* data = kind.type == Imf::FLOAT  ? static_cast<const void*>(floats[c].data())
                           : kind.type == Imf::HALF ? static_cast<const void*>(halves[c].data())
                                                    : integers[c].data();
        frame.insert(name, Imf::Slice::Make(kind.type, data, window));
    }
    Output output;
    if (kind.tiled) {
        header.setTileDescription(Imf::TileDescription(32, 24, Imf::MIPMAP_LEVELS));
        Imf::TiledOutputFile file(output, header);
        file.setFrameBuffer(frame);
        for (int level = 0; level < file.numLevels(); ++level) {
            // The coarser levels hold other pixels, so that reading one of them shows.
            if (level == 1) {
                for (auto& plane : floats) {
                    std::fill(plane.begin(), plane.end(), -1.0f);
                }
            }
            file.writeTiles(0, file.numXTiles(level) - 1, 0, file.numYTiles(level) - 1, level);
        }
    } else {
        Imf::OutputFile file(output, header);
        file.setFrameBuffer(frame);
        file.writePixels(height);
    }
    return output.text;
}

class ExrKinds : public ::testing::TestWithParam<Kind> {};

TEST_P(ExrKinds, IsRead) {
    const ScratchDirectory scratch;
    write_text(scratch / "a.exr", encoded(GetParam()));
    const std::vector<Layer> layers = read_exr(scratch / "a.exr");
    ASSERT_EQ(layers.size(), 1u);
    const Image& image = layers[0].image;
    ASSERT_EQ(image.width, width);
    ASSERT_EQ(image.height, height);
    ASSERT_EQ(image.pixels.size(), static_cast<std::size_t>(width * height));
    for (int i = 0; i < width * height; ++i) {
        ASSERT_EQ(image.pixels[static_cast<std::size_t>(i)],
                  glm::vec3(sample(2, i), sample(1, i), sample(0, i)))
            << "pixel " << i;
    }
}

TEST_P(ExrKinds, SurvivesDamage) {
    const ScratchDirectory scratch;
    const std::string whole = encoded(GetParam());
    std::uint32_t state = 1;
    const auto random = [&](std::size_t below) {
        state = state * 1664525u + 1013904223u;
        return static_cast<std::size_t>((std::uint64_t{state} * below) >> 32);
    };
    constexpr int rounds = 400;
    int read = 0, refused = 0;
    for (int round = 0; round < rounds; ++round) {
        std::string damaged = whole;
        // Every third file loses its end; damage is as frequent in the header as after it.
        if (round % 3 == 0) {
            damaged.resize(1 + random(damaged.size()));
        }
        const std::size_t reach =
            round % 2 == 0 ? std::min<std::size_t>(damaged.size(), 400) : damaged.size();
        for (std::size_t left_over = 1 + random(6); left_over > 0; --left_over) {
            const std::size_t place = random(reach);
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
    EXPECT_EQ(read + refused, rounds);
    EXPECT_GT(refused, rounds / 3);
}

/// Reads the bytes of a file in memory.
class Input : public Imf::IStream {
public:
    explicit Input(std::string bytes) : Imf::IStream("memory"), text_(std::move(bytes)) {}
    bool read(char bytes[], int count) override {
        const auto size = static_cast<std::size_t>(count);
        if (size > text_.size() - place_) {
            throw std::runtime_error("the file is too short");
        }
        std::memcpy(bytes, text_.data() + place_, size);
        place_ += size;
        return place_ < text_.size();
    }
    std::uint64_t tellg() override { return place_; }
    void seekg(std::uint64_t place) override { place_ = place; }

private:
    std::string text_;
    std::size_t place_ = 0;
};

TEST(ExrCompression, TheOtherLibraryReadsOurFiles) {
    const ScratchDirectory scratch;
    const Layer layers[] = {{"", noise(width, height, 1)}, {"indirect", noise(width, height, 2)}};
    write_exr(scratch / "a.exr", layers);
    Input input(read_text(scratch / "a.exr"));
    Imf::InputFile file(input);
    const Imath::Box2i window({0, 0}, {width - 1, height - 1});
    EXPECT_TRUE(file.isComplete());
    EXPECT_EQ(file.header().compression(), Imf::ZIP_COMPRESSION);
    EXPECT_EQ(file.header().dataWindow(), window);
    EXPECT_EQ(file.header().displayWindow(), window);
    for (const Layer& layer : layers) {
        for (int c = 0; c < 3; ++c) {
            const std::string name = (layer.name.empty() ? "" : layer.name + ".") + "RGB"[c];
            const Imf::Channel* channel = file.header().channels().findChannel(name);
            ASSERT_NE(channel, nullptr) << name;
            EXPECT_EQ(channel->type, Imf::FLOAT) << name;
            std::vector<float> samples(layer.image.pixels.size());
            Imf::FrameBuffer frame;
            frame.insert(name, Imf::Slice::Make(Imf::FLOAT, samples.data(), window));
            file.setFrameBuffer(frame);
            file.readPixels(0, height - 1);
            for (std::size_t i = 0; i < samples.size(); ++i) {
                ASSERT_EQ(samples[i], layer.image.pixels[i][c]) << name << " of pixel " << i;
            }
        }
    }
}

TEST(ExrCompression, RefusesUnsupportedCompressions) {
    const ScratchDirectory scratch;
    const auto error = [&](const Kind& kind) {
        write_text(scratch / "a.exr", encoded(kind));
        return error_of([&] { read_exr(scratch / "a.exr"); });
    };
    EXPECT_THAT(error({"", Imf::B44_COMPRESSION, Imf::HALF}), HasSubstr("B44,"));
    EXPECT_THAT(error({"", Imf::B44A_COMPRESSION, Imf::HALF}), HasSubstr("B44A"));
    EXPECT_THAT(error({"", Imf::DWAA_COMPRESSION, Imf::FLOAT}), HasSubstr("DWAA"));
    EXPECT_THAT(error({"", Imf::DWAB_COMPRESSION, Imf::FLOAT, true}), HasSubstr("DWAB"));
}

INSTANTIATE_TEST_SUITE_P(Compression, ExrKinds,
                         ::testing::Values(Kind{"NoneFloat", Imf::NO_COMPRESSION, Imf::FLOAT},
                                           Kind{"NoneHalf", Imf::NO_COMPRESSION, Imf::HALF},
                                           Kind{"NoneInteger", Imf::NO_COMPRESSION, Imf::UINT},
                                           Kind{"NoneTiles", Imf::NO_COMPRESSION, Imf::FLOAT, true},
                                           Kind{"RleFloat", Imf::RLE_COMPRESSION, Imf::FLOAT},
                                           Kind{"RleHalf", Imf::RLE_COMPRESSION, Imf::HALF},
                                           Kind{"ZipsFloat", Imf::ZIPS_COMPRESSION, Imf::FLOAT},
                                           Kind{"ZipsHalf", Imf::ZIPS_COMPRESSION, Imf::HALF},
                                           Kind{"ZipFloat", Imf::ZIP_COMPRESSION, Imf::FLOAT},
                                           Kind{"ZipHalf", Imf::ZIP_COMPRESSION, Imf::HALF},
                                           Kind{"ZipInteger", Imf::ZIP_COMPRESSION, Imf::UINT},
                                           Kind{"ZipTiles", Imf::ZIP_COMPRESSION, Imf::FLOAT, true},
                                           Kind{"PizFloat", Imf::PIZ_COMPRESSION, Imf::FLOAT},
                                           Kind{"PizHalf", Imf::PIZ_COMPRESSION, Imf::HALF},
                                           Kind{"PizTiles", Imf::PIZ_COMPRESSION, Imf::FLOAT, true},
                                           Kind{"Pxr24Float", Imf::PXR24_COMPRESSION, Imf::FLOAT},
                                           Kind{"Pxr24Half", Imf::PXR24_COMPRESSION, Imf::HALF},
                                           Kind{"Pxr24Integer", Imf::PXR24_COMPRESSION, Imf::UINT}),
                         [](const auto& instance) { return instance.param.name; });

} // namespace
