#include "image/exr.hpp"

#include "base/atomic_write.hpp"
#include "base/error.hpp"
#include "base/read_file.hpp"
#include "base/text.hpp"
#include "image/exr_check.hpp"
#include "image/image_size.hpp"
#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <map>
#include <memory>
#include <new>
#include <set>
#include <string>
#include <tinyexr.h>

namespace argand {

namespace {

constexpr std::size_t longest_channel_name = 255;
constexpr std::size_t longest_short_name = 31; // beyond it the file needs the flag for long names

constexpr std::size_t decoder_overrun =
    64; // tinyexr's PIZ decoder takes codes before it tests for their end

struct Header : EXRHeader {
    Header() { InitEXRHeader(this); }
    ~Header() { FreeEXRHeader(this); }
    Header(const Header&) = delete;
    Header& operator=(const Header&) = delete;
};

struct Picture : EXRImage {
    Picture() { InitEXRImage(this); }
    ~Picture() { FreeEXRImage(this); }
    Picture(const Picture&) = delete;
    Picture& operator=(const Picture&) = delete;
};

/// What tinyexr says is wrong, in one line.
std::string take_message(const char* message) {
    const std::string text = message != nullptr ? one_line(message) : "tinyexr does not say why";
    FreeEXRErrorMessage(message);
    return text;
}

void check_layers(const std::filesystem::path& path, std::span<const Layer> layers) {
    if (layers.empty()) {
        fail("cannot write '{}': there is no picture to write", path.string());
    }
    std::set<std::string_view> names;
    for (const Layer& layer : layers) {
        check_size_to_write(path, layer.image);
        if (layer.image.width != layers[0].image.width ||
            layer.image.height != layers[0].image.height) {
            fail("cannot write '{}': layer '{}' is {} × {} but the first is {} × {}", path.string(),
                 layer.name, layer.image.width, layer.image.height, layers[0].image.width,
                 layers[0].image.height);
        }
        if (!names.insert(layer.name).second) {
            fail("cannot write '{}': two layers are named '{}'", path.string(), layer.name);
        }
        if (layer.name.size() + 2 > longest_channel_name ||
            layer.name.find('\0') != std::string::npos) {
            fail("cannot write '{}': a layer's name is longer than {} bytes or holds a zero byte",
                 path.string(), longest_channel_name - 2);
        }
    }
    if (layers[0].image.pixels.size() * layers.size() * 3 > most_samples) {
        fail("cannot write '{}': {} layers of {} × {} pixels are more than 4 GiB", path.string(),
             layers.size(), layers[0].image.width, layers[0].image.height);
    }
}

/// Planes by channel name; OpenEXR wants them in the order of their names.
std::map<std::string, std::vector<float>> planes_of(std::span<const Layer> layers) {
    std::map<std::string, std::vector<float>> planes;
    for (const Layer& layer : layers) {
        for (int channel = 0; channel < 3; ++channel) {
            std::vector<float> plane(layer.image.pixels.size());
            for (std::size_t i = 0; i < plane.size(); ++i) {
                plane[i] = layer.image.pixels[i][channel];
            }
            planes.emplace((layer.name.empty() ? "" : layer.name + ".") + "RGB"[channel],
                           std::move(plane));
        }
    }
    return planes;
}

/// Where a channel belongs: "NAME.R" is channel "R" of layer "NAME".
struct Place {
    std::string layer, channel;
};

Place place_of(const std::string& name) {
    const std::size_t dot = name.rfind('.');
    if (dot == std::string::npos) {
        return {"", name};
    }
    return {name.substr(0, dot), name.substr(dot + 1)};
}

std::vector<float> plane_of(const Picture& picture, const Header& header, int channel) {
    const std::size_t count =
        static_cast<std::size_t>(picture.width) * static_cast<std::size_t>(picture.height);
    std::vector<float> plane(count);
    if (header.requested_pixel_types[channel] == TINYEXR_PIXELTYPE_UINT) {
        const auto* samples = reinterpret_cast<const std::uint32_t*>(picture.images[channel]);
        std::copy_n(samples, count, plane.begin());
    } else {
        std::memcpy(plane.data(), picture.images[channel], count * sizeof(float));
    }
    return plane;
}

std::vector<Layer> layers_of(const Picture& picture, const Header& header, std::string_view file) {
    std::map<std::string, std::map<std::string, int>> channels; // by layer, then by name
    std::string all;
    for (int i = 0; i < header.num_channels; ++i) {
        const std::string name = header.channels[i].name;
        const Place place = place_of(name);
        channels[place.layer][place.channel] = i;
        all += (i == 0 ? "" : ", ") + name;
    }
    std::vector<Layer> layers;
    for (const auto& [name, members] : channels) {
        const bool grey = members.contains("Y");
        const bool color = members.contains("R") || members.contains("G") || members.contains("B");
        if (!grey && !color) {
            continue;
        }
        Image image{picture.width, picture.height, {}};
        image.pixels.resize(static_cast<std::size_t>(image.width) *
                            static_cast<std::size_t>(image.height));
        for (int c = 0; c < 3; ++c) {
            const auto member = members.find(color ? std::string(1, "RGB"[c]) : "Y");
            if (member == members.end()) {
                continue;
            }
            const std::vector<float> plane = plane_of(picture, header, member->second);
            for (std::size_t i = 0; i < plane.size(); ++i) {
                image.pixels[i][c] = plane[i];
            }
        }
        layers.push_back({name, std::move(image)});
    }
    if (layers.empty()) {
        fail("cannot read '{}': none of its channels is R, G, B or Y; it has {}", file,
             one_line(all));
    }
    return layers;
}

} // namespace

void write_exr(const std::filesystem::path& path, std::span<const Layer> layers) {
    check_layers(path, layers);
    std::map<std::string, std::vector<float>> planes = planes_of(layers);

    std::vector<EXRChannelInfo> channels(planes.size(), EXRChannelInfo{});
    std::vector<int> types(planes.size(), TINYEXR_PIXELTYPE_FLOAT);
    std::vector<unsigned char*> samples;
    EXRHeader header;
    InitEXRHeader(&header);
    for (auto& [name, plane] : planes) {
        std::memcpy(channels[samples.size()].name, name.c_str(), name.size() + 1);
        samples.push_back(reinterpret_cast<unsigned char*>(plane.data()));
        header.long_name |= name.size() > longest_short_name ? 1 : 0;
    }
    header.num_channels = static_cast<int>(planes.size());
    header.channels = channels.data();
    header.pixel_types = types.data();
    header.requested_pixel_types = types.data();
    header.compression_type = TINYEXR_COMPRESSIONTYPE_ZIP;

    EXRImage picture;
    InitEXRImage(&picture);
    picture.width = layers[0].image.width;
    picture.height = layers[0].image.height;
    picture.num_channels = header.num_channels;
    picture.images = samples.data();

    unsigned char* memory = nullptr;
    const char* message = nullptr;
    const std::size_t size = SaveEXRImageToMemory(&picture, &header, &memory, &message);
    const std::unique_ptr<unsigned char, decltype(&std::free)> owner(memory, &std::free);
    if (size == 0) {
        fail("cannot write '{}': {}", path.string(), take_message(message));
    }
    write_atomically(path, std::span<const std::uint8_t>(memory, size));
}

std::vector<Layer> read_exr(const std::filesystem::path& path) try {
    const std::string file = one_line(path.string(), 4096);
    std::vector<std::uint8_t> bytes = read_file(path);
    check_exr(bytes, file);
    const std::size_t size = bytes.size();
    bytes.resize(size + decoder_overrun);

    Header header;
    EXRVersion version{};
    const char* message = nullptr;
    if (ParseEXRVersionFromMemory(&version, bytes.data(), size) != TINYEXR_SUCCESS ||
        ParseEXRHeaderFromMemory(&header, &version, bytes.data(), size, &message) !=
            TINYEXR_SUCCESS) {
        fail("cannot read '{}': {}", file, take_message(message));
    }
    for (int i = 0; i < header.num_channels; ++i) {
        if (header.pixel_types[i] == TINYEXR_PIXELTYPE_HALF) {
            header.requested_pixel_types[i] = TINYEXR_PIXELTYPE_FLOAT;
        }
    }
    // A chunk states its rows; tinyexr would turn files whose chunks are stored bottom first upside
    // down.
    header.line_order = 0;
    Picture picture;
    // Where decoding fails tinyexr frees the picture, but no more channels than this says, and
    // leaves the pointers.
    picture.num_channels = header.num_channels;
    if (LoadEXRImageFromMemory(&picture, &header, bytes.data(), size, &message) !=
        TINYEXR_SUCCESS) {
        InitEXRImage(&picture);
        fail("cannot read '{}': {} It is damaged; render or copy it again", file,
             take_message(message));
    }
    return layers_of(picture, header, file);
} catch (const std::bad_alloc&) {
    fail("cannot read '{}': there is not enough memory for it", path.string());
}

} // namespace argand
