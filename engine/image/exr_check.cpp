#include "image/exr_check.hpp"

#include "base/error.hpp"
#include "base/text.hpp"
#include "image/image_size.hpp"
#include <algorithm>
#include <bit>
#include <cstring>
#include <map>
#include <string>

namespace argand {

static_assert(std::endian::native == std::endian::little,
              "OpenEXR is little-endian; so are numbers read here");

namespace {

using Bytes = std::span<const std::uint8_t>;

constexpr std::size_t longest_name = 255;
constexpr std::size_t most_channels = 1024;

enum Flags : std::uint32_t { tiled = 0x200, long_names = 0x400, deep = 0x800, multi_part = 0x1000 };

struct Compression {
    std::string_view name;
    int rows_in_chunk; ///< 0: not decoded here
};

constexpr Compression compressions[] = {
    {"none", 1},  {"RLE", 1}, {"ZIPS", 1}, {"ZIP", 16}, {"PIZ", 32},
    {"PXR24", 0}, {"B44", 0}, {"B44A", 0}, {"DWAA", 0}, {"DWAB", 0},
};

/// Takes values from the front of a run of bytes; an Error, "it ends within WHERE", where there are
/// not enough.
struct Reader {
    Bytes bytes;
    std::string_view file;

    Bytes take(std::size_t count, std::string_view where) {
        if (bytes.size() < count) {
            fail("cannot read '{}': it ends within {}; it is cut short or damaged", file, where);
        }
        const Bytes front = bytes.first(count);
        bytes = bytes.subspan(count);
        return front;
    }

    template <class T> T number(std::string_view where) {
        T value;
        std::memcpy(&value, take(sizeof(T), where).data(), sizeof(T));
        return value;
    }

    /// Up to the next zero byte.
    std::string text(std::string_view where) {
        const auto end = std::find(bytes.begin(), bytes.end(), std::uint8_t{0});
        if (end == bytes.end()) {
            take(bytes.size() + 1, where);
        }
        const Bytes letters = take(static_cast<std::size_t>(end - bytes.begin()) + 1, where);
        if (letters.size() > longest_name + 1) {
            fail("cannot read '{}': a name in its header is longer than {} bytes; it is damaged",
                 file, longest_name);
        }
        return std::string(letters.begin(), letters.end() - 1);
    }
};

using Header = std::map<std::string, Bytes>;

Header read_header(Reader& reader) {
    Header header;
    for (std::string name = reader.text("its header"); !name.empty();
         name = reader.text("its header")) {
        reader.text("its header"); // the type, which the name implies
        const auto size = reader.number<std::uint32_t>("its header");
        if (!header.emplace(name, reader.take(size, "its header")).second) {
            fail("cannot read '{}': its header holds '{}' twice; it is damaged", reader.file,
                 one_line(name));
        }
    }
    return header;
}

Reader attribute(const Header& header, const char* name, std::size_t size, std::string_view file) {
    const auto found = header.find(name);
    if (found == header.end() || found->second.size() < size) {
        fail("cannot read '{}': its header has no valid '{}'; it is damaged", file, name);
    }
    return {found->second, file};
}

/// Number of bytes of a pixel.
std::uint64_t check_channels(Reader channels) {
    std::uint64_t bytes_per_pixel = 0;
    std::size_t count = 0;
    for (std::string name = channels.text("its list of channels"); !name.empty();
         name = channels.text("its list of channels")) {
        const auto type = channels.number<std::uint32_t>("its list of channels");
        channels.take(4, "its list of channels");
        const auto x_sampling = channels.number<std::int32_t>("its list of channels");
        const auto y_sampling = channels.number<std::int32_t>("its list of channels");
        if (type > 2) {
            fail("cannot read '{}': channel '{}' has the unknown type {}; it is damaged",
                 channels.file, one_line(name), type);
        }
        if (x_sampling != 1 || y_sampling != 1) {
            fail("cannot read '{}': channel '{}' is sub-sampled, which is not supported; save it "
                 "as R, G, B",
                 channels.file, one_line(name));
        }
        bytes_per_pixel += type == 1 ? 2 : 4;
        ++count;
    }
    if (count == 0 || count > most_channels) {
        fail("cannot read '{}': it has {} channels; 1 to {} can be read", channels.file, count,
             most_channels);
    }
    return bytes_per_pixel;
}

constexpr std::uint8_t no_compression = 0, piz = 4;

struct Window {
    std::int64_t x0, y0, width, height;
};

Window check_window(Reader window) {
    const std::int64_t x0 = window.number<std::int32_t>("its header");
    const std::int64_t y0 = window.number<std::int32_t>("its header");
    const std::int64_t x1 = window.number<std::int32_t>("its header");
    const std::int64_t y1 = window.number<std::int32_t>("its header");
    const Window box{x0, y0, x1 - x0 + 1, y1 - y0 + 1};
    // tinyexr takes rows beyond ±2^21 for damage.
    constexpr std::int64_t farthest = 1 << 20;
    const bool near = std::min(x0, y0) >= -farthest && std::max(x1, y1) <= farthest;
    if (box.width < 1 || box.height < 1 || box.width > longest_side || box.height > longest_side ||
        !near) {
        fail("cannot read '{}': its data window ({}, {}) to ({}, {}) is empty or too large; the "
             "longest side "
             "is {}",
             window.file, x0, y0, x1, y1, longest_side);
    }
    return box;
}

/// The parts of a PIZ chunk, a bitmap of the values that occur and a Huffman code, must fill it:
/// tinyexr reads as far as their sizes say.
bool is_sound_piz(Reader chunk) {
    constexpr std::size_t bitmap_size = 8192, huffman_header = 20;
    const auto first = chunk.number<std::uint16_t>("its rows");
    const auto last = chunk.number<std::uint16_t>("its rows");
    if (last >= bitmap_size) {
        return false;
    }
    if (first <= last) {
        chunk.take(std::size_t{last} - first + 1, "its rows");
    }
    const auto length = chunk.number<std::uint32_t>("its rows");
    return length == chunk.bytes.size() && length >= huffman_header;
}

/// Every chunk must lie within the file and hold the rows that its place in the table says.
void check_chunks(Reader table, Bytes file, const Window& window, std::uint8_t method,
                  std::uint64_t row_bytes) {
    const int rows_in_chunk = compressions[method].rows_in_chunk;
    for (std::int64_t row = 0; row < window.height; row += rows_in_chunk) {
        const auto offset = table.number<std::uint64_t>("its table of rows");
        if (offset == 0) {
            fail("cannot read '{}': row {} of {} was never written; render it again", table.file,
                 row, window.height);
        }
        if (offset > file.size()) {
            fail("cannot read '{}': it ends before row {} of {}; it is cut short or damaged",
                 table.file, row, window.height);
        }
        Reader chunk{file.subspan(offset), table.file};
        const auto first_row = chunk.number<std::int32_t>("its rows");
        const auto size = chunk.number<std::uint32_t>("its rows");
        const Bytes data = chunk.take(size, "its rows");
        const std::int64_t rows = std::min<std::int64_t>(rows_in_chunk, window.height - row);
        const std::uint64_t full = row_bytes * static_cast<std::uint64_t>(rows);
        // What compression would not make smaller is stored as it is.
        const bool stored = size == full;
        const bool sound = stored || (size > 0 && size < full && method != no_compression &&
                                      (method != piz || is_sound_piz({data, table.file})));
        if (first_row != window.y0 + row || !sound) {
            fail("cannot read '{}': the rows from {} on are damaged; render or copy it again",
                 table.file, row);
        }
    }
}

} // namespace

void check_exr(Bytes bytes, std::string_view name) {
    Reader reader{bytes, name};
    if (bytes.empty()) {
        fail("cannot read '{}': it is empty; render or copy it again", name);
    }
    if (bytes.size() < 4 || reader.number<std::uint32_t>("its header") != 20000630) {
        fail("cannot read '{}': it is not an OpenEXR file; check its name", name);
    }
    const auto version = reader.number<std::uint32_t>("its header");
    if ((version & 0xff) != 2) {
        fail("cannot read '{}': it is of OpenEXR version {}, not 2", name, version & 0xff);
    }
    if ((version & (tiled | deep | multi_part)) != 0) {
        fail("cannot read '{}': it is a {} file, which is not supported; save it as single-part "
             "scan lines",
             name,
             (version & deep) != 0    ? "deep"
             : (version & tiled) != 0 ? "tiled"
                                      : "multi-part");
    }
    if ((version & ~std::uint32_t{0xff | long_names}) != 0) {
        fail("cannot read '{}': its header has unknown flags; it is damaged or of a newer version",
             name);
    }

    const Header header = read_header(reader);
    const std::uint64_t bytes_per_pixel = check_channels(attribute(header, "channels", 1, name));
    const Window window = check_window(attribute(header, "dataWindow", 16, name));
    const auto method =
        attribute(header, "compression", 1, name).number<std::uint8_t>("its header");
    if (method >= std::size(compressions) || compressions[method].rows_in_chunk == 0) {
        fail("cannot read '{}': its compression, {}, is not supported; save it with ZIP", name,
             method < std::size(compressions) ? compressions[method].name : "an unknown one");
    }
    if (header.contains("type")) {
        const Reader type = attribute(header, "type", 1, name);
        if (std::string(type.bytes.begin(), type.bytes.end()).c_str() !=
            std::string_view("scanlineimage")) {
            fail("cannot read '{}': its type is not 'scanlineimage'; save it as single-part scan "
                 "lines",
                 name);
        }
    }
    const std::uint64_t row_bytes = bytes_per_pixel * static_cast<std::uint64_t>(window.width);
    if (row_bytes * static_cast<std::uint64_t>(window.height) > 4 * most_samples) {
        fail("cannot read '{}': its {} × {} pixels of {} bytes are more than 4 GiB", name,
             window.width, window.height, bytes_per_pixel);
    }
    const int rows_in_chunk = compressions[method].rows_in_chunk;
    if (header.contains("chunkCount")) {
        const auto stated =
            attribute(header, "chunkCount", 4, name).number<std::int32_t>("its header");
        if (stated != (window.height + rows_in_chunk - 1) / rows_in_chunk) {
            fail("cannot read '{}': its 'chunkCount' of {} does not fit its {} rows; it is damaged",
                 name, stated, window.height);
        }
    }
    check_chunks(reader, bytes, window, method, row_bytes);
}

} // namespace argand
