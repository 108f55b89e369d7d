#include "image/exr.hpp"
#include "image/exr_file.hpp"
#include "image/pictures.hpp"
#include "support/expect_error.hpp"
#include "support/scratch_directory.hpp"
#include <ImfBoxAttribute.h>
#include <ImfChannelList.h>
#include <ImfHeader.h>
#include <ImfInputFile.h>
#include <ImfStringAttribute.h>
#include <bit>
#include <cmath>
#include <limits>
#include <sys/resource.h>

using namespace argand;
using namespace argand::testing;
using ::testing::HasSubstr;

namespace {

std::vector<std::uint32_t> bits(const Image& image) {
    std::vector<std::uint32_t> result;
    for (const glm::vec3& pixel : image.pixels) {
        for (int c = 0; c < 3; ++c) {
            result.push_back(std::bit_cast<std::uint32_t>(pixel[c]));
        }
    }
    return result;
}

std::vector<Layer> read_bytes(const std::string& bytes) {
    const ScratchDirectory scratch;
    write_text(scratch / "file.exr", bytes);
    return read_exr(scratch / "file.exr");
}

std::string floats(std::initializer_list<float> values) {
    std::string bytes;
    for (const float value : values) {
        bytes += ExrFile::number(value);
    }
    return bytes;
}

TEST(Exr, RoundTripIsExactAtEverySize) {
    const ScratchDirectory scratch;
    const int sizes[][2] = {{1, 1}, {1, 37}, {37, 1}, {3, 5}, {16, 16}, {17, 33}, {128, 96}};
    for (const auto& [width, height] : sizes) {
        const Layer written[] = {{"", noise(width, height, 1, 1e3f)}};
        write_exr(scratch / "a.exr", written);
        const std::vector<Layer> read = read_exr(scratch / "a.exr");
        ASSERT_EQ(read.size(), 1u);
        EXPECT_EQ(read[0].name, "");
        EXPECT_EQ(read[0].image.width, width);
        EXPECT_EQ(read[0].image.height, height);
        EXPECT_EQ(bits(read[0].image), bits(written[0].image)) << width << " × " << height;
    }
}

TEST(Exr, KeepsEveryFloat) {
    using Limits = std::numeric_limits<float>;
    const ScratchDirectory scratch;
    Image image{3, 2, {}};
    image.pixels = {{0.0f, -0.0f, 1.0f},
                    {Limits::max(), Limits::lowest(), Limits::min()},
                    {Limits::denorm_min(), -Limits::denorm_min(), 1e-30f},
                    {Limits::infinity(), -Limits::infinity(), Limits::quiet_NaN()},
                    {-1.0f, 0.1f, 65505.0f},
                    {1e30f, -1e30f, 3.0f}};
    const Layer written[] = {{"", image}};
    write_exr(scratch / "a.exr", written);
    EXPECT_EQ(bits(read_exr(scratch / "a.exr")[0].image), bits(image));
}

TEST(Exr, KeepsLayersByName) {
    const ScratchDirectory scratch;
    const std::string long_name(200, 'n');
    // The channels of "Caustic" come before R in the file; the layer "" must still come first.
    const Layer written[] = {{"indirect", noise(9, 7, 2)},
                             {"", noise(9, 7, 1)},
                             {"Caustic", noise(9, 7, 3)},
                             {"a.b", noise(9, 7, 4)},
                             {long_name, noise(9, 7, 5)}};
    write_exr(scratch / "a.exr", written);
    const std::vector<Layer> read = read_exr(scratch / "a.exr");
    ASSERT_EQ(read.size(), 5u);
    const int order[] = {1, 2, 3, 0, 4}; // "", then by name
    for (std::size_t i = 0; i < read.size(); ++i) {
        EXPECT_EQ(read[i].name, written[order[i]].name);
        EXPECT_EQ(bits(read[i].image), bits(written[order[i]].image)) << read[i].name;
    }
}

TEST(Exr, KeepsLayersOfOtherChannels) {
    const ScratchDirectory scratch;
    const Layer written[] = {
        {"", noise(9, 7, 1)}, {"normal", noise(9, 7, 2), "XYZ"}, {"depth", noise(9, 7, 3), "Z"}};
    write_exr(scratch / "a.exr", written);
    std::vector<std::string> channels;
    Imf::InputFile file((scratch / "a.exr").c_str());
    for (auto c = file.header().channels().begin(); c != file.header().channels().end(); ++c) {
        channels.emplace_back(c.name());
    }
    EXPECT_THAT(channels, ::testing::ElementsAre("B", "G", "R", "depth.Z", "normal.X", "normal.Y",
                                                 "normal.Z"));
    const std::vector<Layer> read = read_exr(scratch / "a.exr");
    ASSERT_EQ(read.size(), 3u);
    EXPECT_EQ(bits(read[2].image), bits(written[1].image));
    for (std::size_t i = 0; i < 9 * 7; ++i) {
        EXPECT_EQ(read[1].image.pixels[i].z, written[2].image.pixels[i].x);
        EXPECT_EQ(read[1].image.pixels[i].x, 0);
    }
}

// OpenEXR's own library reads the attributes.
TEST(Exr, SaysHowItWasMadeAndWhereItLies) {
    const ScratchDirectory scratch;
    const Layer layers[] = {{"", noise(9, 7, 1)}};
    write_exr(scratch / "a.exr", layers,
              {.display = {},
               .window = {.x = 3, .y = 5, .full_width = 20, .full_height = 30},
               .command = "argand render 'a ü.glb'"});
    const Imf::InputFile file((scratch / "a.exr").c_str());
    EXPECT_EQ(file.header().typedAttribute<Imf::StringAttribute>("comments").value(),
              "argand render 'a ü.glb'");
    EXPECT_EQ(file.header().dataWindow(), Imath::Box2i({3, 5}, {11, 11}));
    EXPECT_EQ(file.header().displayWindow(), Imath::Box2i({0, 0}, {19, 29}));
    EXPECT_EQ(bits(read_exr(scratch / "a.exr")[0].image), bits(layers[0].image));
}

TEST(Exr, WritesTheSameBytesTwice) {
    const ScratchDirectory scratch;
    const Layer layers[] = {{"", noise(33, 17, 1)}};
    write_exr(scratch / "a.exr", layers);
    write_exr(scratch / "b.exr", layers);
    EXPECT_EQ(read_text(scratch / "a.exr"), read_text(scratch / "b.exr"));
}

TEST(Exr, RefusesLayersThatFormNoImage) {
    const ScratchDirectory scratch;
    const auto error = [&](std::vector<Layer> layers) {
        return error_of([&] { write_exr(scratch / "a.exr", layers); });
    };
    EXPECT_THAT(error({}), HasSubstr("no picture"));
    EXPECT_THAT(error({{"", Image{}}}), HasSubstr("0 × 0"));
    EXPECT_THAT(error({{"", Image{2, 2, {{}, {}}}}}), HasSubstr("2 pixels but its size is 2 × 2"));
    EXPECT_THAT(error({{"", Image{100000, 1, {}}}}), HasSubstr("100000"));
    EXPECT_THAT(error({{"", noise(2, 2, 1)}, {"x", noise(2, 3, 1)}}), HasSubstr("'x' is 2 × 3"));
    EXPECT_THAT(error({{"x", noise(2, 2, 1)}, {"x", noise(2, 2, 1)}}),
                HasSubstr("two layers are named 'x'"));
    EXPECT_THAT(error({{std::string(300, 'x'), noise(2, 2, 1)}}), HasSubstr("longer than"));
    EXPECT_TRUE(scratch.names().empty());
}

TEST(Exr, RefusesPlacesItCannotWriteTo) {
    const ScratchDirectory scratch;
    const Layer layers[] = {{"", noise(2, 2, 1)}};
    std::filesystem::create_directory(scratch / "folder.exr");
    EXPECT_THAT(error_of([&] { write_exr(scratch / "folder.exr", layers); }),
                HasSubstr("it is a directory"));
    EXPECT_THAT(error_of([&] { write_exr(scratch / "none/a.exr", layers); }),
                HasSubstr("does not exist"));
}

TEST(Exr, ReadsHalvesAndIntegers) {
    ExrFile file{.width = 2, .height = 1};
    const auto halves =
        ExrFile::number(std::uint16_t{0x3c00}) + ExrFile::number(std::uint16_t{0xc100}); // 1, −2.5
    const auto integers =
        ExrFile::number(std::uint32_t{7}) + ExrFile::number(std::uint32_t{4000000000});
    file.channels = {{"B", 0, integers},
                     {"G", 2, floats({0.5f, 1e-3f})},
                     {"R", 1, halves},
                     {"Z", 2, floats({9, 9})}};
    const std::vector<Layer> read = read_bytes(file.bytes());
    ASSERT_EQ(read.size(), 1u);
    EXPECT_EQ(read[0].image.pixels[0], glm::vec3(1, 0.5f, 7));
    EXPECT_EQ(read[0].image.pixels[1], glm::vec3(-2.5f, 1e-3f, 4e9f));
}

TEST(Exr, ReadsGreyAndFillsMissingChannels) {
    ExrFile file{.width = 1, .height = 2};
    file.channels = {
        {"Y", 2, floats({3, 4})}, {"lamp.A", 2, floats({1, 1})}, {"lamp.G", 2, floats({5, 6})}};
    const std::vector<Layer> read = read_bytes(file.bytes());
    ASSERT_EQ(read.size(), 2u);
    EXPECT_EQ(read[0].image.pixels[1], glm::vec3(4));
    EXPECT_EQ(read[1].name, "lamp");
    EXPECT_EQ(read[1].image.pixels[1], glm::vec3(0, 6, 0));
}

TEST(Exr, ReadsRowsStoredBottomFirstAndWindowsElsewhere) {
    ExrFile file{.width = 1, .height = 3, .x0 = -5, .y0 = -7};
    file.channels = {{"Y", 2, floats({1, 2, 3})}};
    for (const bool bottom_first : {false, true}) {
        file.bottom_first = bottom_first;
        const Image image = read_bytes(file.bytes())[0].image;
        EXPECT_EQ(image.pixels, (std::vector<glm::vec3>{glm::vec3(1), glm::vec3(2), glm::vec3(3)}));
    }
}

std::string error_reading(const std::string& bytes) {
    return error_of([&] { read_bytes(bytes); });
}

TEST(ExrHostile, NamesTheUnsupportedOrDamagedPart) {
    ExrFile good;
    good.channels = {{"Y", 2, floats({1})}};
    EXPECT_NO_THROW(read_bytes(good.bytes()));
    const auto error = [&](auto change) {
        ExrFile file = good;
        change(file);
        return error_reading(file.bytes());
    };
    EXPECT_THAT(error([](ExrFile& f) { f.version |= 0x200; }), HasSubstr("tile"));
    EXPECT_THAT(error([](ExrFile& f) { f.version |= 0x800; }), HasSubstr("deep"));
    EXPECT_THAT(error([](ExrFile& f) { f.version |= 0x1000; }), HasSubstr("multi-part"));
    EXPECT_THAT(error([](ExrFile& f) { f.version |= 0x100000; }), HasSubstr("unsupported flags"));
    EXPECT_THAT(error([](ExrFile& f) { f.version = 3; }), HasSubstr("version: 3"));
    EXPECT_THAT(error([](ExrFile& f) { f.compression = 8; }), HasSubstr("DWAA"));
    EXPECT_THAT(error([](ExrFile& f) { f.compression = 200; }), HasSubstr("compression"));
    EXPECT_THAT(error([](ExrFile& f) { f.channels[0].sampling = 2; }), HasSubstr("subsampling"));
    EXPECT_THAT(error([](ExrFile& f) {
                    f.width = 2;
                    f.height = 2;
                    f.channels[0].sampling = 2;
                    f.channels[0].samples = std::string(16, '\0');
                }),
                HasSubstr("sub-sampled"));
    EXPECT_THAT(error([](ExrFile& f) { f.channels[0].sampling = 0; }), HasSubstr("sampling"));
    EXPECT_THAT(error([](ExrFile& f) { f.channels[0].type = 3; }),
                HasSubstr("pixel type specified (3)"));
    EXPECT_THAT(error([](ExrFile& f) { f.channels[0].name = "Z"; }), HasSubstr("it has Z"));
    EXPECT_THAT(error([](ExrFile& f) { f.channels[0].name = std::string(300, 'n'); }),
                HasSubstr("channels"));
    EXPECT_THAT(error([](ExrFile& f) { f.channels.clear(); }), HasSubstr("one channel"));
    const auto with = [&](const std::string& name, const std::string& type,
                          const std::string& value) {
        return error(
            [&](ExrFile& f) { f.extra_attributes = ExrFile::attribute(name, type, value); });
    };
    EXPECT_THAT(with("type", "string", "strange"), HasSubstr("type"));
    EXPECT_THAT(with("type", "string", "tiledimage"), HasSubstr("tile"));
    EXPECT_THAT(with("dataWindow", "box2i", std::string(16, '\0')), HasSubstr("Duplicate"));
}

TEST(ExrHostile, IgnoresTheStatedNumberOfChunks) {
    ExrFile file;
    file.channels = {{"Y", 2, floats({3})}};
    file.extra_attributes = ExrFile::attribute("chunkCount", "int", ExrFile::number(1 << 30));
    EXPECT_EQ(read_bytes(file.bytes())[0].image.pixels, std::vector<glm::vec3>{glm::vec3(3)});
}

TEST(ExrHostile, RefusesAHeaderThatLacksAnAttribute) {
    ExrFile file;
    file.channels = {{"Y", 2, floats({1})}};
    const std::string good = file.bytes();
    for (const std::string name : {"channels", "compression", "dataWindow", "displayWindow",
                                   "lineOrder", "pixelAspectRatio"}) {
        std::string renamed = good;
        renamed[good.find(name)] = '?';
        EXPECT_THAT(error_reading(renamed), HasSubstr(name));
    }
}

TEST(ExrHostile, RefusesAttributesLongerThanTheFile) {
    ExrFile file;
    file.channels = {{"Y", 2, floats({1})}};
    for (const std::string type :
         {"string", "stringvector", "floatvector", "preview", "chlist", "unheard of"}) {
        file.extra_attributes = std::string("comment") + '\0' + type + '\0' +
                                ExrFile::number(std::int32_t{0x7ffffff0}) + "abcd";
        error_reading(file.bytes());
    }
}

TEST(ExrHostile, RefusesAbsurdSizes) {
    ExrFile file;
    file.channels = {{"Y", 2, floats({1})}};
    const std::string good = file.bytes();
    const std::size_t window = good.find("dataWindow") + 11 + 6 + 4;
    const auto with = [&](std::int32_t x0, std::int32_t y0, std::int32_t x1, std::int32_t y1) {
        const std::string box =
            ExrFile::number(x0) + ExrFile::number(y0) + ExrFile::number(x1) + ExrFile::number(y1);
        return error_reading(std::string(good).replace(window, 16, box));
    };
    constexpr std::int32_t least = std::numeric_limits<std::int32_t>::min();
    constexpr std::int32_t most = std::numeric_limits<std::int32_t>::max();
    EXPECT_THAT(with(0, 0, -1, 0), HasSubstr("data window"));
    EXPECT_THAT(with(0, 0, 0, -1), HasSubstr("data window"));
    EXPECT_THAT(with(least, least, most, most), HasSubstr("data window"));
    EXPECT_THAT(with(0, 0, 65536, 0), HasSubstr("data window"));
    EXPECT_THAT(with(most, most, most, most), HasSubstr("data window"));
    EXPECT_THAT(with(0, 0, 65535, 65535), HasSubstr("4 GiB"));
    EXPECT_THAT(with(0, 0, 0, 60000), HasSubstr("too big for file size"));
    EXPECT_THAT(with(0, 0, 10, 0), HasSubstr("damaged"));
}

/// Largest number of bytes that this process has had in physical memory.
long peak_memory() {
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    return usage.ru_maxrss * 1024;
}

TEST(ExrHostile, TakesNoMemoryForPixelsThatTheFileLacks) {
    constexpr int height = 16384, chunks = height / 16; // with 65536 columns: 4 GiB of samples
    ExrFile file;
    file.channels = {{"Y", 2, ""}};
    file.compression = 3; // ZIP, 16 rows a chunk
    std::string bytes = file.header();
    bytes.replace(bytes.find("dataWindow") + 11 + 6 + 4, 16,
                  floats({0, 0}) + ExrFile::number(65535) + ExrFile::number(height - 1));
    const std::size_t first_chunk = bytes.size() + std::size_t{8} * chunks;
    for (int chunk = 0; chunk < chunks; ++chunk) {
        bytes += ExrFile::number(std::uint64_t{first_chunk});
    }
    bytes += ExrFile::number(0) + ExrFile::number(100) + std::string(100, 'x');
    const long before = peak_memory();
    error_reading(bytes);
    EXPECT_LT(peak_memory() - before, 64 << 20);
}

/// Reads an image or an error of one line, and does not crash, whatever the bytes are.
void expect_picture_or_error(const std::filesystem::path& path, const std::string& bytes) {
    write_text(path, bytes);
    try {
        for (const Layer& layer : read_exr(path)) {
            EXPECT_EQ(layer.image.pixels.size(),
                      static_cast<std::size_t>(layer.image.width * layer.image.height));
        }
    } catch (const Error& error) {
        EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos) << error.what();
    }
}

std::string our_file() {
    const ScratchDirectory scratch;
    const Layer layers[] = {{"", noise(20, 33, 1)}, {"direct", constant(20, 33, glm::vec3(0.5f))}};
    write_exr(scratch / "a.exr", layers);
    return read_text(scratch / "a.exr");
}

TEST(ExrHostile, SurvivesTruncationAtEveryLength) {
    const ScratchDirectory scratch;
    const std::string whole = our_file();
    for (std::size_t size = 0; size < whole.size(); size += size < 700 ? 1 : 37) {
        write_text(scratch / "cut.exr", whole.substr(0, size));
        error_of([&] { read_exr(scratch / "cut.exr"); });
    }
}

TEST(ExrHostile, SurvivesDamageAnywhere) {
    const ScratchDirectory scratch;
    const std::string whole = our_file();
    for (std::size_t place = 0; place < whole.size(); place += place < 700 ? 1 : 53) {
        for (const char value : {'\0', '\x01', '\x7f', '\x80', '\xff'}) {
            std::string damaged = whole;
            damaged[place] = value;
            expect_picture_or_error(scratch / "damaged.exr", damaged);
        }
    }
}

TEST(ExrHostile, SurvivesDamageUnderEveryCompression) {
    const ScratchDirectory scratch;
    ExrFile file{.width = 24, .height = 40};
    std::string samples;
    std::uint32_t state = 1;
    for (int i = 0; i < file.width * file.height * 2; ++i) {
        state = state * 1664525u + 1013904223u;
        samples += static_cast<char>(state >> 24);
    }
    file.channels = {{"Y", 1, samples}};
    for (std::uint8_t compression = 0; compression <= 4; ++compression) {
        file.compression = compression;
        expect_picture_or_error(scratch / "noise.exr", file.bytes());
    }
}

TEST(ExrHostile, NamesThePathOfAnUnreadableFile) {
    const ScratchDirectory scratch;
    EXPECT_THAT(error_of([&] { read_exr(scratch / "none.exr"); }), HasSubstr("none.exr"));
    EXPECT_THAT(error_of([&] { read_exr(scratch.path()); }), HasSubstr("directory"));
    EXPECT_THAT(error_reading(""), HasSubstr("empty"));
    EXPECT_THAT(error_reading("\x89PNG\r\n"), HasSubstr("not an OpenEXR file"));
    EXPECT_THAT(error_reading("v/1\x01"), HasSubstr("Unable to read"));
}

} // namespace
