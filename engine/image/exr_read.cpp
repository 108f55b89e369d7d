#include "base/error.hpp"
#include "base/read_file.hpp"
#include "base/text.hpp"
#include "image/exr.hpp"
#include "image/exr_context.hpp"
#include "image/image_size.hpp"
#include <algorithm>
#include <cstdint>
#include <map>
#include <new>
#include <optional>
#include <string>
#include <utility>

namespace argand {

namespace {

constexpr int most_channels = 1024;
constexpr std::uint64_t largest_chunk = std::uint64_t{1} << 30; // bytes
/// A data window lies within ± this, so that no sum of its coordinates overflows.
constexpr std::int32_t farthest = 1 << 20;

/// Checks the first bytes of a file, so that a wrong kind of file is named as such.
void check_kind(std::span<const std::uint8_t> bytes, const std::string& task) {
    constexpr std::uint8_t signature[] = {0x76, 0x2f, 0x31, 0x01};
    constexpr std::uint8_t deep = 0x08, multi_part = 0x10; // in the second byte of the version
    if (bytes.empty()) {
        fail("{}: it is empty; render or copy it again", task);
    }
    if (bytes.size() < std::size(signature) ||
        !std::equal(std::begin(signature), std::end(signature), bytes.begin())) {
        fail("{}: it is not an OpenEXR file; check its name", task);
    }
    if (bytes.size() > 5 && (bytes[5] & (deep | multi_part)) != 0) {
        fail("{}: it is a {} file, which is not supported; save it as a flat single-part image",
             task, (bytes[5] & deep) != 0 ? "deep" : "multi-part");
    }
}

/// Layout of the image that a file holds.
struct Layout {
    exr_attr_box2i_t window{};
    int width = 0, height = 0;
    const exr_attr_chlist_t* channels = nullptr;
    bool tiled = false;
};

/// Refuses the compressions that OpenEXR's C library 3.1 decodes wrongly (B44) or not at all (DWA).
void check_compression(const ExrContext& context) {
    exr_compression_t method = EXR_COMPRESSION_NONE;
    context.check(exr_get_compression(context, 0, &method));
    const char* name = method == EXR_COMPRESSION_B44    ? "B44"
                       : method == EXR_COMPRESSION_B44A ? "B44A"
                       : method == EXR_COMPRESSION_DWAA ? "DWAA"
                       : method == EXR_COMPRESSION_DWAB ? "DWAB"
                                                        : nullptr;
    if (name != nullptr) {
        fail("{}: its compression, {}, is not supported; save it with ZIP", context.task(), name);
    }
}

/// Reads the layout from the header and limits the memory that decoding may take.
Layout layout_of(const ExrContext& context) {
    Layout layout;
    exr_storage_t storage = EXR_STORAGE_SCANLINE;
    context.check(exr_get_storage(context, 0, &storage));
    layout.tiled = storage == EXR_STORAGE_TILED;
    context.check(exr_get_data_window(context, 0, &layout.window));
    const std::int32_t x0 = layout.window.min.x, y0 = layout.window.min.y;
    const std::int32_t x1 = layout.window.max.x, y1 = layout.window.max.y;
    const std::int64_t width = std::int64_t{x1} - x0 + 1, height = std::int64_t{y1} - y0 + 1;
    if (width < 1 || height < 1 || width > longest_side || height > longest_side ||
        std::min(x0, y0) < -farthest || std::max(x1, y1) > farthest) {
        fail("{}: its data window ({}, {}) to ({}, {}) is empty or too large; the longest side is "
             "{}",
             context.task(), x0, y0, x1, y1, longest_side);
    }
    layout.width = static_cast<int>(width);
    layout.height = static_cast<int>(height);

    context.check(exr_get_channels(context, 0, &layout.channels));
    const int count = layout.channels->num_channels;
    if (count < 1 || count > most_channels) {
        fail("{}: it has {} channels; 1 to {} can be read", context.task(), count, most_channels);
    }
    std::uint64_t bytes_per_pixel = 0;
    for (int i = 0; i < count; ++i) {
        const exr_attr_chlist_entry_t& channel = layout.channels->entries[i];
        if (channel.x_sampling != 1 || channel.y_sampling != 1) {
            fail("{}: channel '{}' is sub-sampled, which is not supported; save it as R, G, B",
                 context.task(), one_line(channel.name.str));
        }
        bytes_per_pixel += channel.pixel_type == EXR_PIXEL_HALF ? 2 : 4;
    }
    if (static_cast<std::uint64_t>(width * height) * bytes_per_pixel > 4 * most_samples) {
        fail("{}: its {} × {} pixels of {} bytes are more than 4 GiB", context.task(), width,
             height, bytes_per_pixel);
    }
    std::uint64_t chunk = 0;
    context.check(exr_get_chunk_unpacked_size(context, 0, &chunk));
    if (chunk > largest_chunk) {
        fail("{}: a block of its pixels has {} bytes, more than 1 GiB; save it as scan lines with "
             "ZIP",
             context.task(), chunk);
    }
    return layout;
}

/// The component of a layer that a channel fills; a channel that no layer uses has none.
struct Destination {
    std::size_t layer;
    int component;
};

struct Decoded {
    std::vector<Layer> layers;
    std::vector<std::optional<Destination>> destinations; ///< by channel, in the file's order
    std::vector<bool> grey;                               ///< by layer: it has Y alone
};

/// Finds the layers that the channels form: "NAME.R" is channel "R" of layer "NAME".
Decoded layers_of(const ExrContext& context, const Layout& layout) {
    std::map<std::string, std::map<std::string, std::size_t>> channels; // by layer, then by name
    std::string all;
    const auto count = static_cast<std::size_t>(layout.channels->num_channels);
    for (std::size_t i = 0; i < count; ++i) {
        const std::string name = layout.channels->entries[i].name.str;
        const std::size_t dot = name.rfind('.');
        const bool has_layer = dot != std::string::npos;
        channels[has_layer ? name.substr(0, dot) : ""][has_layer ? name.substr(dot + 1) : name] = i;
        all += (i == 0 ? "" : ", ") + name;
    }
    Decoded decoded;
    decoded.destinations.resize(count);
    for (const auto& [name, members] : channels) {
        const auto has = [&members = members](const char* channel) {
            return members.contains(channel);
        };
        const bool vector = !name.empty() && (has("X") || has("Z"));
        const std::string letters = has("R") || has("G") || has("B") ? "RGB" : vector ? "XYZ" : "Y";
        const bool grey = letters == "Y";
        if (grey && !has("Y")) {
            continue;
        }
        for (std::size_t c = 0; c < letters.size(); ++c) {
            if (const auto member = members.find(letters.substr(c, 1)); member != members.end()) {
                decoded.destinations[member->second] = {decoded.layers.size(), static_cast<int>(c)};
            }
        }
        decoded.layers.push_back({name, Image{layout.width, layout.height, {}}});
        decoded.layers.back().channels = grey ? "RGB" : letters;
        decoded.grey.push_back(grey);
    }
    if (decoded.layers.empty()) {
        fail("{}: none of its channels is R, G, B or Y; it has {}", context.task(), one_line(all));
    }
    return decoded;
}

/// Decodes chunks, which are rows of the image or tiles, into the layers. The layers grow with the
/// rows that are decoded, so that a header cannot demand memory for pixels that the file lacks.
class Decoder {
public:
    Decoder(const ExrContext& context, const Layout& layout, Decoded& decoded)
        : context_(context), layout_(layout), decoded_(decoded) {}
    ~Decoder() { exr_decoding_destroy(context_, &pipeline_); }
    Decoder(const Decoder&) = delete;
    Decoder& operator=(const Decoder&) = delete;

    void decode_rows() {
        std::int32_t rows_in_chunk = 0;
        context_.check(exr_get_scanlines_per_chunk(context_, 0, &rows_in_chunk));
        for (int row = 0; row < layout_.height; row += rows_in_chunk) {
            exr_chunk_info_t chunk;
            context_.check(
                exr_read_scanline_chunk_info(context_, 0, layout_.window.min.y + row, &chunk));
            decode(chunk, 0, row);
        }
    }

    /// Decodes the finest level of detail.
    void decode_tiles() {
        std::int32_t tile_width = 0, tile_height = 0;
        context_.check(exr_get_tile_sizes(context_, 0, 0, 0, &tile_width, &tile_height));
        for (int row = 0, y = 0; row < layout_.height; row += tile_height, ++y) {
            for (int column = 0, x = 0; column < layout_.width; column += tile_width, ++x) {
                exr_chunk_info_t chunk;
                context_.check(exr_read_tile_chunk_info(context_, 0, x, y, 0, 0, &chunk));
                decode(chunk, column, row);
            }
        }
    }

private:
    void decode(const exr_chunk_info_t& chunk, int column, int row) {
        const auto width = static_cast<std::size_t>(layout_.width);
        // OpenEXR 3.1 accepts an uncompressed chunk that is too short.
        if (chunk.compression == EXR_COMPRESSION_NONE && chunk.packed_size != chunk.unpacked_size) {
            fail("{}: the rows from {} on are damaged; render or copy it again", context_.task(),
                 row);
        }
        if (column + chunk.width > layout_.width || row + chunk.height > layout_.height) {
            fail("{}: its pixels lie outside its data window; it is damaged", context_.task());
        }
        for (Layer& layer : decoded_.layers) {
            layer.image.pixels.resize(static_cast<std::size_t>(row + chunk.height) * width);
        }
        const bool first = row == 0 && column == 0;
        context_.check(first ? exr_decoding_initialize(context_, 0, &chunk, &pipeline_)
                             : exr_decoding_update(context_, 0, &chunk, &pipeline_));
        const std::size_t start =
            static_cast<std::size_t>(row) * width + static_cast<std::size_t>(column);
        for (std::size_t c = 0; c < decoded_.destinations.size(); ++c) {
            if (const auto& to = decoded_.destinations[c]) {
                exr_coding_channel_info_t& channel = pipeline_.channels[c];
                channel.decode_to_ptr = reinterpret_cast<std::uint8_t*>(
                    &decoded_.layers[to->layer].image.pixels[start][to->component]);
                channel.user_data_type = EXR_PIXEL_FLOAT;
                channel.user_bytes_per_element = sizeof(float);
                channel.user_pixel_stride = sizeof(glm::vec3);
                channel.user_line_stride = static_cast<std::int32_t>(sizeof(glm::vec3) * width);
            }
        }
        if (first) {
            context_.check(exr_decoding_choose_default_routines(context_, 0, &pipeline_));
        }
        context_.check(exr_decoding_run(context_, 0, &pipeline_));
    }

    const ExrContext& context_;
    const Layout& layout_;
    Decoded& decoded_;
    exr_decode_pipeline_t pipeline_ = EXR_DECODE_PIPELINE_INITIALIZER;
};

} // namespace

std::vector<Layer> read_exr(const std::filesystem::path& path) try {
    const std::string task = fmt::format("cannot read '{}'", one_line(path.string(), 4096));
    const std::vector<std::uint8_t> bytes = read_file(path);
    check_kind(bytes, task);
    ExrContext context(task, "render or copy it again");
    context.start_reading(bytes);
    check_compression(context);
    const Layout layout = layout_of(context);
    Decoded decoded = layers_of(context, layout);
    Decoder decoder(context, layout, decoded);
    if (layout.tiled) {
        decoder.decode_tiles();
    } else {
        decoder.decode_rows();
    }
    for (std::size_t i = 0; i < decoded.layers.size(); ++i) {
        if (decoded.grey[i]) {
            for (glm::vec3& pixel : decoded.layers[i].image.pixels) {
                pixel = glm::vec3(pixel.r);
            }
        }
    }
    return std::move(decoded.layers);
} catch (const std::bad_alloc&) {
    fail("cannot read '{}': there is not enough memory for it", path.string());
}

} // namespace argand
