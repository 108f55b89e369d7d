#include "image/png.hpp"

#include "base/atomic_write.hpp"
#include "base/error.hpp"
#include "base/read_file.hpp"
#include "base/text.hpp"
#include "image/image_size.hpp"
#include "image/srgb.hpp"
#include <cmath>
#include <cstdint>
#include <limits>
#include <memory>
#include <new>
#include <span>
#include <string_view>
#include <vector>
#include <zlib.h>

// Static, so that this copy of stb does not clash with another one in the program. Only these two
// decoders are compiled, so that a file that pretends to be a PNG reaches no other one.
#define STB_IMAGE_STATIC
#define STB_IMAGE_IMPLEMENTATION
#define STBI_ONLY_PNG
#define STBI_ONLY_HDR
#define STBI_NO_STDIO
#define STBI_MAX_DIMENSIONS 65536
#define STB_IMAGE_WRITE_STATIC
#define STB_IMAGE_WRITE_IMPLEMENTATION
#define STBI_WRITE_NO_STDIO
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wunused-function"
#include <stb_image.h>
#include <stb_image_write.h>
#pragma GCC diagnostic pop

namespace argand {

namespace {

constexpr int rgb = 3;

template <class T> using Samples = std::unique_ptr<T, decltype(&stbi_image_free)>;

template <class T> Samples<T> hold(T* samples) { return {samples, &stbi_image_free}; }

void append(void* context, void* data, int size) {
    auto& bytes = *static_cast<std::vector<std::uint8_t>*>(context);
    const auto* begin = static_cast<const std::uint8_t*>(data);
    bytes.insert(bytes.end(), begin, begin + size);
}

/// Reads a file that `is_kind` recognises and that is small enough for stb (2 GiB).
std::vector<std::uint8_t> read_bytes(const std::filesystem::path& path, const char* kind,
                                     int (*is_kind)(const stbi_uc*, int)) {
    std::vector<std::uint8_t> bytes = read_file(path);
    const std::string file = one_line(path.string(), 4096);
    if (bytes.empty()) {
        fail("cannot read '{}': it is empty; render or copy it again", file);
    }
    if (bytes.size() > static_cast<std::size_t>(std::numeric_limits<int>::max())) {
        fail("cannot read '{}': it is larger than 2 GiB", file);
    }
    if (is_kind(bytes.data(), static_cast<int>(bytes.size())) == 0) {
        fail("cannot read '{}': it is not a {} file; check its name", file, kind);
    }
    return bytes;
}

int is_png(const stbi_uc* bytes, int size) {
    constexpr std::uint8_t signature[] = {0x89, 'P', 'N', 'G', '\r', '\n', 0x1a, '\n'};
    return size >= 8 && std::equal(std::begin(signature), std::end(signature), bytes) ? 1 : 0;
}

void append_big_endian(std::vector<std::uint8_t>& bytes, std::uint32_t value) {
    for (int shift = 24; shift >= 0; shift -= 8) {
        bytes.push_back(static_cast<std::uint8_t>(value >> shift));
    }
}

/// Adds the text "Comment" behind the header of a PNG: a chunk iTXt, not compressed, in UTF-8 (PNG
/// specification, section 11.3.3.4).
void add_comment(std::vector<std::uint8_t>& png, const std::string& comment) {
    using namespace std::string_literals;
    constexpr std::ptrdiff_t behind_header = 8 + 4 + 4 + 13 + 4; // signature and chunk IHDR
    const std::string body = "iTXtComment\0\0\0\0\0"s + comment;
    std::vector<std::uint8_t> chunk;
    append_big_endian(chunk, static_cast<std::uint32_t>(body.size() - 4));
    chunk.insert(chunk.end(), body.begin(), body.end());
    append_big_endian(chunk, static_cast<std::uint32_t>(
                                 crc32(0, chunk.data() + 4, static_cast<uInt>(body.size()))));
    png.insert(png.begin() + behind_header, chunk.begin(), chunk.end());
}

template <class T, class Convert>
Image to_image(const T* samples, int width, int height, Convert convert) {
    Image image{width, height, {}};
    image.pixels.resize(static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
    for (std::size_t i = 0; i < image.pixels.size(); ++i) {
        for (int c = 0; c < rgb; ++c) {
            image.pixels[i][c] = convert(samples[i * rgb + static_cast<std::size_t>(c)]);
        }
    }
    return image;
}

/// The linear value of every sRGB code of the unsigned integer type T.
template <class T> std::vector<float> decode_table() {
    constexpr std::size_t codes = std::size_t{std::numeric_limits<T>::max()} + 1;
    std::vector<float> table(codes);
    for (std::size_t i = 0; i < codes; ++i) {
        table[i] = static_cast<float>(
            srgb_decode(static_cast<double>(i) / static_cast<double>(codes - 1)));
    }
    return table;
}

[[noreturn]] void fail_to_decode(const std::filesystem::path& path) {
    const char* reason = stbi_failure_reason();
    fail("cannot read '{}': it is damaged ({}); render or copy it again",
         one_line(path.string(), 4096), reason != nullptr ? reason : "unknown reason");
}

/// Checks that a Radiance file has a size that can be read, and at least as many bytes as its
/// pixels take: the decoder fills in what is missing.
void check_hdr(const std::filesystem::path& path, std::span<const std::uint8_t> bytes) {
    const std::string file = one_line(path.string(), 4096);
    int width = 0, height = 0, channels = 0;
    const int size = static_cast<int>(bytes.size());
    if (stbi_info_from_memory(bytes.data(), size, &width, &height, &channels) == 0) {
        fail_to_decode(path);
    }
    if (width < 1 || height < 1 || width > longest_side || height > longest_side ||
        std::uint64_t(width) * std::uint64_t(height) * rgb > most_samples) {
        fail("cannot read '{}': its size of {} × {} pixels is not one that can be read; render or "
             "copy it again",
             file, width, height);
    }
    // The header ends with an empty line and the line of the size.
    const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    constexpr std::size_t npos = std::string_view::npos;
    const std::size_t end_of_header = text.find("\n\n");
    const std::size_t end_of_size =
        end_of_header == npos ? npos : text.find('\n', end_of_header + 2);
    const auto pixels =
        end_of_size == npos ? bytes.subspan(bytes.size()) : bytes.subspan(end_of_size + 1);
    // Rows of run lengths: a mark of four bytes, then two bytes for each 127 values at the most.
    const auto columns = static_cast<std::uint64_t>(width);
    const bool runs = width >= 8 && width < 32768 && pixels.size() >= 4 && pixels[0] == 2 &&
                      pixels[1] == 2 && pixels[2] < 128;
    const std::uint64_t least =
        std::uint64_t(height) * (runs ? 4 + 8 * ((columns + 126) / 127) : 4 * columns);
    if (pixels.size() < least) {
        fail(
            "cannot read '{}': it is cut short: {} × {} pixels take at least {} bytes, of which it "
            "has {}; render or copy it again",
            file, width, height, least, pixels.size());
    }
}

} // namespace

std::vector<std::uint8_t> srgb_bytes(const Image& image, const Display& display) {
    const double scale = std::exp2(static_cast<double>(display.exposure_ev));
    std::vector<std::uint8_t> samples;
    samples.reserve(image.pixels.size() * rgb);
    for (const glm::vec3& pixel : image.pixels) {
        glm::dvec3 color = glm::dvec3(pixel) * scale;
        if (display.tone != Tone::linear) {
            color = apply_tone(display.tone, color);
        }
        for (int c = 0; c < rgb; ++c) {
            samples.push_back(static_cast<std::uint8_t>(255 * srgb_encode(color[c]) + 0.5));
        }
    }
    return samples;
}

std::vector<std::uint8_t> png_bytes(const Image& image, const PictureSettings& settings,
                                    const std::filesystem::path& name) {
    check_size_to_write(name, image);
    const std::vector<std::uint8_t> samples = srgb_bytes(image, settings.display);
    std::vector<std::uint8_t> bytes;
    if (samples.size() > static_cast<std::size_t>(std::numeric_limits<int>::max()) ||
        stbi_write_png_to_func(&append, &bytes, image.width, image.height, rgb, samples.data(),
                               0) == 0) {
        fail("cannot write '{}': a PNG of {} × {} pixels is too large; write an .exr",
             name.string(), image.width, image.height);
    }
    if (!settings.command.empty()) {
        add_comment(bytes, settings.command);
    }
    return bytes;
}

void write_png(const std::filesystem::path& path, const Image& image,
               const PictureSettings& settings) {
    write_atomically(path, png_bytes(image, settings, path));
}

Image read_png(const std::filesystem::path& path) try {
    const std::vector<std::uint8_t> bytes = read_bytes(path, "PNG", &is_png);
    const int size = static_cast<int>(bytes.size());
    int width = 0, height = 0, channels = 0;
    if (stbi_is_16_bit_from_memory(bytes.data(), size) != 0) {
        const auto samples =
            hold(stbi_load_16_from_memory(bytes.data(), size, &width, &height, &channels, rgb));
        if (samples == nullptr) {
            fail_to_decode(path);
        }
        const std::vector<float> linear = decode_table<std::uint16_t>();
        return to_image(samples.get(), width, height,
                        [&](std::uint16_t code) { return linear[code]; });
    }
    const auto samples =
        hold(stbi_load_from_memory(bytes.data(), size, &width, &height, &channels, rgb));
    if (samples == nullptr) {
        fail_to_decode(path);
    }
    const std::vector<float> linear = decode_table<std::uint8_t>();
    return to_image(samples.get(), width, height, [&](std::uint8_t code) { return linear[code]; });
} catch (const std::bad_alloc&) {
    fail("cannot read '{}': there is not enough memory for it", path.string());
}

Image read_hdr(const std::filesystem::path& path) try {
    const std::vector<std::uint8_t> bytes =
        read_bytes(path, "Radiance HDR", &stbi_is_hdr_from_memory);
    check_hdr(path, bytes);
    int width = 0, height = 0, channels = 0;
    const auto samples = hold(stbi_loadf_from_memory(bytes.data(), static_cast<int>(bytes.size()),
                                                     &width, &height, &channels, rgb));
    if (samples == nullptr) {
        fail_to_decode(path);
    }
    return to_image(samples.get(), width, height, [](float value) { return value; });
} catch (const std::bad_alloc&) {
    fail("cannot read '{}': there is not enough memory for it", path.string());
}

} // namespace argand
