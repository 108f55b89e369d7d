#include "scene/decode_image.hpp"

#include "base/error.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <limits>
#include <memory>

// Static, so that this copy of stb does not clash with another one in the program. Only the two
// decoders that glTF allows are compiled.
#define STB_IMAGE_STATIC
#define STB_IMAGE_IMPLEMENTATION
#define STBI_ONLY_PNG
#define STBI_ONLY_JPEG
#define STBI_NO_STDIO
#define STBI_MAX_DIMENSIONS 65536
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wunused-function"
#include <stb_image.h>
#pragma GCC diagnostic pop

namespace argand {

namespace {

constexpr int samples_of_texel = 4;

constexpr std::uint8_t jpeg_escape = 0xff, jpeg_start = 0xd8, jpeg_end = 0xd9, jpeg_scan = 0xda;

bool is_png(std::span<const std::uint8_t> bytes) {
    constexpr std::array<std::uint8_t, 8> signature{0x89, 'P', 'N', 'G', '\r', '\n', 0x1a, '\n'};
    return bytes.size() >= signature.size() &&
           std::equal(signature.begin(), signature.end(), bytes.begin());
}

bool is_jpeg(std::span<const std::uint8_t> bytes) {
    return bytes.size() >= 4 && bytes[0] == jpeg_escape && bytes[1] == jpeg_start &&
           bytes[2] == jpeg_escape;
}

/// Whether a JPEG's data has the marker that ends it. stb fills what is missing with grey.
bool has_end(std::span<const std::uint8_t> bytes) {
    // Segments before the data state their length; previews in them may end, too.
    std::size_t at = 2;
    while (at + 4 <= bytes.size() && bytes[at] == jpeg_escape && bytes[at + 1] != jpeg_scan) {
        at += 2 + (std::size_t{bytes[at + 2]} << 8 | bytes[at + 3]);
    }
    if (at >= bytes.size()) {
        return false;
    }
    constexpr std::array<std::uint8_t, 2> end{jpeg_escape, jpeg_end};
    return std::search(bytes.begin() + static_cast<std::ptrdiff_t>(at), bytes.end(), end.begin(),
                       end.end()) != bytes.end();
}

/// The number of components that a JPEG's frame header states; 0 if there is none.
int jpeg_components(std::span<const std::uint8_t> bytes) {
    constexpr std::uint8_t first_frame = 0xc0, last_frame = 0xcf; // but for three other segments
    std::size_t at = 2;
    while (at + 9 < bytes.size() && bytes[at] == jpeg_escape && bytes[at + 1] != jpeg_scan) {
        const std::uint8_t kind = bytes[at + 1];
        if (kind >= first_frame && kind <= last_frame && kind != 0xc4 && kind != 0xc8 &&
            kind != 0xcc) {
            return bytes[at + 9];
        }
        at += 2 + (std::size_t{bytes[at + 2]} << 8 | bytes[at + 3]);
    }
    return 0;
}

/// Throws Error unless the image has few enough texels.
void check_size(std::uint64_t width, std::uint64_t height) {
    if (width > most_texels || height > most_texels || width * height > most_texels) {
        fail("it has {} x {} pixels, more than {} million; make it smaller", width, height,
             most_texels >> 20);
    }
}

/// Throws Error if the header of a PNG states too many pixels. stb only says that it is damaged.
void check_png_size(std::span<const std::uint8_t> bytes) {
    constexpr std::size_t width_at = 16, height_at = 20;
    if (bytes.size() < height_at + 4) {
        return;
    }
    const auto word = [&](std::size_t at) {
        return std::uint64_t{bytes[at]} << 24 | std::uint64_t{bytes[at + 1]} << 16 |
               std::uint64_t{bytes[at + 2]} << 8 | bytes[at + 3];
    };
    check_size(word(width_at), word(height_at));
}

void find_range(TextureImage& image) {
    for (const std::uint32_t texel : image.texels) {
        const auto color = std::bit_cast<glm::u8vec4>(texel);
        image.low = glm::min(image.low, color);
        image.high = glm::max(image.high, color);
    }
}

} // namespace

TextureImage decode_image(std::span<const std::uint8_t> bytes, const std::string& name) {
    if (bytes.empty()) {
        fail("it is empty");
    }
    if (!is_png(bytes) && !is_jpeg(bytes)) {
        fail("it is neither PNG nor JPEG; convert it to one of them");
    }
    if (bytes.size() > std::size_t{std::numeric_limits<int>::max()}) {
        fail("it is larger than 2 GiB; make it smaller");
    }
    if (is_jpeg(bytes) && !has_end(bytes)) {
        fail("it is cut short; copy it again");
    }
    if (is_jpeg(bytes) && jpeg_components(bytes) > 3) {
        fail(
            "it is a JPEG of four components (CMYK), which glTF does not allow; convert it to RGB");
    }
    if (is_png(bytes)) {
        check_png_size(bytes);
    }
    const int size = static_cast<int>(bytes.size());
    int width = 0, height = 0, in_file = 0;
    if (stbi_info_from_memory(bytes.data(), size, &width, &height, &in_file) == 0) {
        fail("it is damaged or cut short; copy it again");
    }
    const std::uint64_t count = std::uint64_t(width) * std::uint64_t(height);
    check_size(std::uint64_t(width), std::uint64_t(height));
    const std::unique_ptr<stbi_uc, decltype(&stbi_image_free)> samples(
        stbi_load_from_memory(bytes.data(), size, &width, &height, &in_file, samples_of_texel),
        &stbi_image_free);
    if (samples == nullptr) {
        fail("it is damaged or cut short; copy it again");
    }
    static_assert(std::endian::native == std::endian::little, "red is the lowest byte of a texel");
    TextureImage image{.name = name,
                       .width = static_cast<std::uint32_t>(width),
                       .height = static_cast<std::uint32_t>(height),
                       .texels = std::vector<std::uint32_t>(count)};
    std::memcpy(image.texels.data(), samples.get(), count * samples_of_texel);
    find_range(image);
    return image;
}

} // namespace argand
