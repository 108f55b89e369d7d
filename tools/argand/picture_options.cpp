#include "picture_options.hpp"

#include "base/error.hpp"
#include "base/text.hpp"
#include "numbers.hpp"

#include <array>
#include <cstdlib>
#include <filesystem>
#include <string_view>

namespace argand {

namespace {

/// Quotes an argument where a shell would read it otherwise.
std::string quoted(std::string_view argument) {
    constexpr std::string_view plain = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ"
                                       "0123456789_-+=./,:%@";
    if (!argument.empty() && argument.find_first_not_of(plain) == std::string_view::npos) {
        return std::string(argument);
    }
    std::string text = "'";
    for (const char letter : argument) {
        text += letter == '\'' ? std::string("'\\''") : std::string(1, letter);
    }
    return text + "'";
}

/// Switches on the layers of these names. Returns what is wrong, or nothing.
std::string read_layers(const std::string& names, FeatureLayers& layers) {
    for (std::size_t at = 0; at <= names.size();) {
        const std::size_t end = std::min(names.find(',', at), names.size());
        const std::string name = names.substr(at, end - at);
        if (!add_feature(name, layers)) {
            return fmt::format("'{}' is no layer; there are albedo, normal, depth, id and variance",
                               one_line(name, 40));
        }
        at = end + 1;
    }
    return "";
}

} // namespace

void add_display_options(CLI::App& command, PictureOptions& options) {
    command
        .add_option_function<std::string>(
            "--exposure",
            [&options](const std::string& text) {
                options.automatic = text == "auto";
                options.exposure =
                    options.automatic ? 0 : static_cast<float>(std::strtod(text.c_str(), nullptr));
            },
            "Exposure of the PNG in stops, or auto: the mean luminance, in the geometric sense, "
            "becomes 18 %")
        ->type_name("FLOAT")
        ->default_str("0")
        ->check(or_auto(number_between(-100, 100)));
    command
        .add_option_function<std::string>(
            "--tone",
            [&options](const std::string& text) {
                options.tone = find_tone(text).value_or(Tone::linear);
            },
            "Curve of the PNG: linear (what exceeds 1 is clamped), neutral (Khronos PBR Neutral: "
            "colours as they are, highlights compressed) or filmic (ACES as Narkowicz fitted it)")
        ->type_name("TEXT")
        ->default_str("linear")
        ->check(CLI::IsMember({"linear", "neutral", "filmic"}));
}

void add_picture_options(CLI::App& command, PictureOptions& options) {
    add_display_options(command, options);
    command
        .add_option_function<std::string>(
            "--aovs", [&options](const std::string& names) { read_layers(names, options.layers); },
            "Further layers of the .exr, separated by commas: albedo (base colour), normal (X, Y, "
            "Z "
            "in world space), depth (Z, along the camera's axis), id (of the object: 1 + the index "
            "of its node in the file), variance (of the pixel's mean, from up to 64 passes)")
        ->type_name("TEXT")
        ->check(CLI::Validator(
            [](const std::string& names) {
                FeatureLayers layers;
                return read_layers(names, layers);
            },
            "albedo,normal,depth,id,variance"));
    command
        .add_option("--crop", options.crop,
                    "Render only the pixels from X0 to X1 - 1 and from Y0 to Y1 - 1 of the "
                    "picture, counted from its top left corner, written X0,Y0,X1,Y1. With path "
                    "and bidirectional they have the bits of the whole picture")
        ->check(CLI::Validator(
            [](const std::string& text) {
                return text.empty() ? "'' is not X0,Y0,X1,Y1" : std::string();
            },
            "X0,Y0,X1,Y1"));
}

std::optional<CropRectangle> parse_crop(const std::string& crop, const PictureSize& size) {
    if (crop.empty()) {
        return std::nullopt;
    }
    std::array<int, 4> numbers{};
    std::string_view rest = crop;
    bool valid = true;
    for (std::size_t i = 0; i < numbers.size(); ++i) {
        const std::size_t comma = i + 1 < numbers.size() ? rest.find(',') : rest.size();
        const std::optional<int> number = comma == std::string_view::npos
                                              ? std::nullopt
                                              : parse_number<int>(rest.substr(0, comma));
        valid = valid && number;
        numbers[i] = number.value_or(0);
        rest.remove_prefix(
            std::min(comma == std::string_view::npos ? rest.size() : comma + 1, rest.size()));
    }
    const CropRectangle rectangle{numbers[0], numbers[1], numbers[2], numbers[3]};
    if (!valid || rectangle.x0 < 0 || rectangle.y0 < 0 || rectangle.x0 >= rectangle.x1 ||
        rectangle.y0 >= rectangle.y1 || rectangle.x1 > size.width || rectangle.y1 > size.height) {
        throw UsageError(fmt::format("reading --crop {}: it must be X0,Y0,X1,Y1 with 0 <= X0 < X1 "
                                     "<= {} and 0 <= Y0 < Y1 <= {}, the size of the picture",
                                     one_line(crop), size.width, size.height));
    }
    return rectangle;
}

PictureSettings picture_settings(const PictureOptions& options, const RenderSettings& settings,
                                 const Image& picture) {
    PictureSettings file{.display = {.exposure_ev = options.exposure, .tone = options.tone},
                         .window = {},
                         .command = options.command};
    if (options.automatic) {
        file.display.exposure_ev = static_cast<float>(automatic_exposure(picture));
    }
    if (settings.crop) {
        file.window = {settings.crop->x0, settings.crop->y0, settings.width, settings.height};
    }
    return file;
}

std::string command_text(int argc, const char* const* argv) {
    constexpr std::size_t longest = 1 << 16;
    std::string text = argc > 0 ? std::filesystem::path(argv[0]).filename().string() : "argand";
    for (int i = 1; i < argc; ++i) {
        text += " " + quoted(argv[i]);
    }
    return one_line(text, longest);
}

} // namespace argand
