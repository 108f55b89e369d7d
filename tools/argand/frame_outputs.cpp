#include "frame_outputs.hpp"

#include "base/clock.hpp"
#include "base/error.hpp"
#include "frames.hpp"
#include "image/files.hpp"
#include "image/png.hpp"

#include <algorithm>
#include <optional>

namespace argand {

namespace {

/// The size of a picture, or of the part of it that is rendered.
PictureSize size_to_write(const RenderOptions& options) {
    const PictureSize size = parse_picture_size(options.size);
    const std::optional<CropRectangle> crop = parse_crop(options.picture.crop, size);
    return crop ? PictureSize{crop->width(), crop->height()} : size;
}

/// The size of a picture in a file, or none if it cannot be read.
std::optional<PictureSize> size_of_picture(const std::string& file) try {
    const std::vector<Layer> layers = read_image(file);
    const Image& picture = whole_picture(layers);
    return PictureSize{picture.width, picture.height};
} catch (const Error&) {
    return std::nullopt;
}

} // namespace

FrameOutputs::FrameOutputs(const RenderOptions& options)
    : outputs_(options.outputs), size_(size_to_write(options)) {
    for (const std::string& output : outputs_) {
        if (is_film(output)) {
            films_.push_back(
                std::make_unique<FilmWriter>(output, size_, options.frames_per_second));
        }
    }
}

std::vector<std::string> FrameOutputs::names(std::uint64_t frame) const {
    std::vector<std::string> names;
    names.reserve(outputs_.size());
    for (const std::string& output : outputs_) {
        names.push_back(is_film(output) ? output : frame_name(output, frame));
    }
    return names;
}

std::vector<std::string> FrameOutputs::names_to_tell(std::uint64_t frame) const {
    std::vector<std::string> told = names(frame);
    for (std::string& name : told) {
        if (is_film(name)) {
            name += fmt::format(" (frame {})", frame);
        }
    }
    return told;
}

bool FrameOutputs::has(std::uint64_t frame) const {
    bool all = true;
    for (const std::string& name : names(frame)) {
        const std::optional<PictureSize> size = size_of_picture(name);
        if (size && (size->width != size_.width || size->height != size_.height)) {
            fail("continuing '{}': it has {} × {} pixels, and not {} × {}; render as before, or "
                 "choose another name",
                 name, size->width, size->height, size_.width, size_.height);
        }
        all = all && size;
    }
    return all;
}

void FrameOutputs::write(RenderJob& job, const Rendered& rendered, std::uint64_t frame) {
    std::vector<std::string> pictures = names(frame);
    pictures.erase(std::remove_if(pictures.begin(), pictures.end(), is_film), pictures.end());
    write_picture(job, rendered, pictures);
    if (films_.empty()) {
        return;
    }
    const Clock::time_point start = Clock::now();
    const std::vector<std::uint8_t> pixels =
        srgb_bytes(whole_picture(rendered.result.layers), file_settings(job, rendered).display);
    for (const std::unique_ptr<FilmWriter>& film : films_) {
        film->add(pixels);
    }
    job.times.write += seconds_since(start);
}

void FrameOutputs::finish() {
    for (const std::unique_ptr<FilmWriter>& film : films_) {
        film->finish();
    }
}

} // namespace argand
