#pragma once

#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

namespace argand::testing {

/// Builds an uncompressed scan-line OpenEXR file byte by byte ("OpenEXR File Layout", openexr.com),
/// with any header, so that the reader is tested on files that no library writes.
struct ExrFile {
    struct Channel {
        std::string name;
        std::uint32_t type;  ///< 0 unsigned integer, 1 half, 2 float
        std::string samples; ///< rows from the top, little-endian
        std::int32_t sampling = 1;
    };

    int width = 1, height = 1;
    std::int32_t x0 = 0, y0 = 0;
    std::vector<Channel> channels{}; ///< sorted by name, as the format requires
    std::uint32_t version = 2;
    std::uint8_t compression = 0;
    bool bottom_first = false;
    std::string extra_attributes{};

    template <class T> static std::string number(T value) {
        std::string bytes(sizeof(T), '\0');
        std::memcpy(bytes.data(), &value, sizeof(T));
        return bytes;
    }

    static std::string attribute(const std::string& name, const std::string& type,
                                 const std::string& value) {
        return name + '\0' + type + '\0' + number(static_cast<std::uint32_t>(value.size())) + value;
    }

    std::string header() const {
        std::string list;
        for (const Channel& channel : channels) {
            list += channel.name + '\0' + number(channel.type) + std::string(4, '\0') +
                    number(channel.sampling) + number(channel.sampling);
        }
        const std::string window =
            number(x0) + number(y0) + number(x0 + width - 1) + number(y0 + height - 1);
        std::string bytes = number(std::uint32_t{20000630}) + number(version);
        bytes += attribute("channels", "chlist", list + '\0');
        bytes +=
            attribute("compression", "compression", std::string(1, static_cast<char>(compression)));
        bytes += attribute("dataWindow", "box2i", window);
        bytes += attribute("displayWindow", "box2i", window);
        bytes += attribute("lineOrder", "lineOrder", std::string(1, bottom_first ? '\1' : '\0'));
        bytes += attribute("pixelAspectRatio", "float", number(1.0f));
        bytes += attribute("screenWindowCenter", "v2f", number(0.0f) + number(0.0f));
        bytes += attribute("screenWindowWidth", "float", number(1.0f));
        return bytes + extra_attributes + '\0';
    }

    std::string bytes() const {
        const std::string head = header();
        std::vector<std::string> chunks(static_cast<std::size_t>(height));
        for (int row = 0; row < height; ++row) {
            std::string data;
            for (const Channel& channel : channels) {
                const std::size_t size =
                    static_cast<std::size_t>(width) * (channel.type == 1 ? 2 : 4);
                data += channel.samples.substr(static_cast<std::size_t>(row) * size, size);
            }
            chunks[static_cast<std::size_t>(row)] =
                number(y0 + row) + number(static_cast<std::uint32_t>(data.size())) + data;
        }
        std::vector<std::uint64_t> offsets(chunks.size());
        std::uint64_t offset = head.size() + 8 * chunks.size();
        std::string body;
        for (std::size_t i = 0; i < chunks.size(); ++i) {
            const std::size_t row = bottom_first ? chunks.size() - 1 - i : i;
            offsets[row] = offset;
            offset += chunks[row].size();
            body += chunks[row];
        }
        std::string table;
        for (const std::uint64_t place : offsets) {
            table += number(place);
        }
        return head + table + body;
    }
};

} // namespace argand::testing
