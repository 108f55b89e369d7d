#include "base/atomic_write.hpp"
#include "base/error.hpp"
#include "image/exr.hpp"
#include "image/exr_context.hpp"
#include "image/image_size.hpp"
#include <algorithm>
#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <string_view>

namespace argand {

namespace {

constexpr std::size_t longest_channel_name = 255;
constexpr std::size_t longest_short_name = 31; // a longer name needs a flag in the file

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

/// The first sample of every channel, by the channel's name.
std::map<std::string, const float*> channels_of(std::span<const Layer> layers) {
    std::map<std::string, const float*> channels;
    for (const Layer& layer : layers) {
        for (std::size_t c = 0; c < layer.channels.size(); ++c) {
            channels.emplace((layer.name.empty() ? "" : layer.name + ".") + layer.channels[c],
                             &layer.image.pixels[0][static_cast<int>(c)]);
        }
    }
    return channels;
}

exr_attr_box2i_t data_window(const CropWindow& window, int width, int height) {
    exr_attr_box2i_t box{};
    box.min.x = window.x;
    box.min.y = window.y;
    box.max.x = window.x + width - 1;
    box.max.y = window.y + height - 1;
    return box;
}

/// Writes the attributes that every file has, and the command.
void set_attributes(const ExrContext& context, int part, const PictureSettings& settings,
                    const exr_attr_box2i_t& window) {
    exr_attr_box2i_t display = window;
    if (settings.window.full_width > 0) {
        display = data_window({}, settings.window.full_width, settings.window.full_height);
    }
    const exr_attr_v2f_t center{};
    context.check(exr_initialize_required_attr(context, part, &display, &window, 1, &center, 1,
                                               EXR_LINEORDER_INCREASING_Y, EXR_COMPRESSION_ZIP));
    if (!settings.command.empty()) {
        context.check(exr_attr_set_string(context, part, "comments", settings.command.c_str()));
    }
}

/// Compresses and writes all chunks of part 0, a whole number of rows each.
void encode_rows(const ExrContext& context, const std::map<std::string, const float*>& channels,
                 const exr_attr_box2i_t& window) {
    const std::int32_t width = window.max.x - window.min.x + 1;
    const std::int32_t height = window.max.y - window.min.y + 1;
    struct Pipeline : exr_encode_pipeline_t {
        explicit Pipeline(exr_context_t of)
            : exr_encode_pipeline_t EXR_ENCODE_PIPELINE_INITIALIZER, owner(of) {}
        ~Pipeline() { exr_encoding_destroy(owner, this); }
        Pipeline(const Pipeline&) = delete;
        Pipeline& operator=(const Pipeline&) = delete;
        exr_context_t owner;
    } pipeline(context);

    std::int32_t rows_in_chunk = 0;
    context.check(exr_get_scanlines_per_chunk(context, 0, &rows_in_chunk));
    for (std::int32_t row = 0; row < height; row += rows_in_chunk) {
        exr_chunk_info_t chunk;
        context.check(exr_write_scanline_chunk_info(context, 0, window.min.y + row, &chunk));
        context.check(row == 0 ? exr_encoding_initialize(context, 0, &chunk, &pipeline)
                               : exr_encoding_update(context, 0, &chunk, &pipeline));
        for (int c = 0; c < pipeline.channel_count; ++c) {
            exr_coding_channel_info_t& channel = pipeline.channels[c];
            const float* first = channels.at(channel.channel_name);
            channel.encode_from_ptr = reinterpret_cast<const std::uint8_t*>(
                first + 3 * static_cast<std::ptrdiff_t>(row) * width);
            channel.user_data_type = EXR_PIXEL_FLOAT;
            channel.user_bytes_per_element = sizeof(float);
            channel.user_pixel_stride = sizeof(glm::vec3);
            channel.user_line_stride = static_cast<std::int32_t>(sizeof(glm::vec3)) * width;
        }
        if (row == 0) {
            context.check(exr_encoding_choose_default_routines(context, 0, &pipeline));
        }
        context.check(exr_encoding_run(context, 0, &pipeline));
    }
}

} // namespace

void write_exr(const std::filesystem::path& path, std::span<const Layer> layers,
               const PictureSettings& settings) {
    check_layers(path, layers);
    const std::map<std::string, const float*> channels = channels_of(layers);
    const int width = layers[0].image.width, height = layers[0].image.height;

    ExrContext context(fmt::format("cannot write '{}'", path.string()), "report it as a bug");
    context.start_writing();
    int part = 0;
    context.check(exr_add_part(context, nullptr, EXR_STORAGE_SCANLINE, &part));
    const exr_attr_box2i_t window = data_window(settings.window, width, height);
    set_attributes(context, part, settings, window);
    if (std::any_of(channels.begin(), channels.end(), [](const auto& channel) {
            return channel.first.size() > longest_short_name;
        })) {
        context.check(exr_set_longname_support(context, 1));
    }
    for (const auto& [name, samples] : channels) {
        context.check(exr_add_channel(context, part, name.c_str(), EXR_PIXEL_FLOAT,
                                      EXR_PERCEPTUALLY_LOGARITHMIC, 1, 1));
    }
    context.check(exr_write_header(context));
    encode_rows(context, channels, window);
    write_atomically(path, context.finish_writing());
}

} // namespace argand
