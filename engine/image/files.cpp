#include "image/files.hpp"

#include "base/atomic_write.hpp"
#include "base/error.hpp"
#include "base/text.hpp"
#include "image/exr.hpp"
#include "image/png.hpp"
#include <string>

namespace argand {

namespace {

[[noreturn]] void fail_unknown(std::string_view verb, const std::filesystem::path& path,
                               std::string_view known) {
    throw UsageError(fmt::format(
        "cannot {} '{}': the extension '{}' is not that of a known picture format; use {}", verb,
        one_line(path.string(), 4096), one_line(path.extension().string()), known));
}

constexpr std::string_view writable = ".exr or .png";
constexpr std::string_view readable = ".exr, .png or .hdr";

} // namespace

std::string lower_extension(const std::filesystem::path& path) {
    std::string extension = path.extension().string();
    for (char& letter : extension) {
        if (letter >= 'A' && letter <= 'Z') {
            letter = static_cast<char>(letter - 'A' + 'a');
        }
    }
    return extension;
}

std::vector<Layer> read_image(const std::filesystem::path& path) {
    const std::string extension = lower_extension(path);
    std::vector<Layer> layers;
    if (extension == ".exr") {
        layers = read_exr(path);
    } else if (extension == ".png") {
        layers.push_back({"", read_png(path)});
    } else if (extension == ".hdr") {
        layers.push_back({"", read_hdr(path)});
    } else {
        fail_unknown("read", path, readable);
    }
    return layers;
}

void write_image(const std::filesystem::path& path, std::span<const Layer> layers,
                 const PictureSettings& settings) {
    const std::string extension = lower_extension(path);
    if (extension == ".exr") {
        write_exr(path, layers, settings);
    } else if (extension == ".png") {
        if (layers.empty()) {
            fail("cannot write '{}': there is no picture to write", path.string());
        }
        write_png(path, whole_picture(layers), settings);
    } else {
        fail_unknown("write", path, writable);
    }
}

void check_image_writable(const std::filesystem::path& path) {
    const std::string extension = lower_extension(path);
    if (extension != ".exr" && extension != ".png") {
        fail_unknown("write", path, writable);
    }
    check_writable(path);
}

const Image* find_layer(std::span<const Layer> layers, std::string_view name) {
    for (const Layer& layer : layers) {
        if (layer.name == name) {
            return &layer.image;
        }
    }
    return nullptr;
}

const Image& whole_picture(std::span<const Layer> layers) {
    const Image* whole = find_layer(layers, "");
    return whole != nullptr ? *whole : layers.front().image;
}

} // namespace argand
