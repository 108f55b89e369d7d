#include "scene/gltf_compression.hpp"

#include "scene/gltf_value.hpp"

#ifdef ARGAND_HAVE_MESHOPTIMIZER
#include <meshoptimizer.h>
#endif

namespace argand {

#ifndef ARGAND_HAVE_MESHOPTIMIZER

void decompress_meshopt(GltfSource&) {}

#else

namespace {

/// A compressed buffer view: the properties of its extension.
struct Compressed {
    std::span<const std::uint8_t> bytes;
    std::size_t count = 0, stride = 0;
    std::string mode, filter;
};

std::string text_in(const GltfSource& source, const nlohmann::json& object, const char* key,
                    const char* otherwise, const std::string& what) {
    const nlohmann::json* value = find_member(&object, key);
    if (!value) {
        return otherwise;
    }
    if (!value->is_string()) {
        source.fail("{} has a \"{}\" that is no text", what, key);
    }
    return one_line(value->get<std::string>(), 40);
}

/// Largest number of bytes that so many compressed ones can stand for. A short file could demand
/// any amount of memory otherwise. Vertices: two bits for 16 bytes at least. Triangles: a byte for
/// three indices. Sequences: a byte for an index.
std::size_t most_bytes(const Compressed& c) {
    constexpr std::size_t slack = 1 << 16;
    const std::size_t factor = c.mode == "ATTRIBUTES"  ? 64
                               : c.mode == "TRIANGLES" ? 3 * c.stride
                                                       : c.stride;
    return c.bytes.size() * factor + slack;
}

Compressed open_compressed(const GltfSource& source, const nlohmann::json& extension,
                           const std::string& what) {
    Compressed c;
    const std::size_t buffer = size_in_extension(source, extension, "buffer", {}, what);
    const std::size_t offset = size_in_extension(source, extension, "byteOffset", 0, what);
    const std::size_t length = size_in_extension(source, extension, "byteLength", {}, what);
    c.bytes = bytes_of_buffer(source, buffer, offset, length, what);
    c.count = size_in_extension(source, extension, "count", {}, what);
    c.stride = size_in_extension(source, extension, "byteStride", {}, what);
    c.mode = text_in(source, extension, "mode", "", what);
    c.filter = text_in(source, extension, "filter", "NONE", what);
    const bool vertices = c.mode == "ATTRIBUTES";
    const bool indices = c.mode == "TRIANGLES" || c.mode == "INDICES";
    if (!vertices && !indices) {
        source.fail("{} has the mode \"{}\", which {} does not know", what, c.mode,
                    meshopt_extension);
    }
    if (vertices ? c.stride == 0 || c.stride > 256 || c.stride % 4 != 0
                 : c.stride != 2 && c.stride != 4) {
        source.fail("{} has elements of {} bytes, which the mode {} does not allow", what, c.stride,
                    c.mode);
    }
    if (c.mode == "TRIANGLES" && c.count % 3 != 0) {
        source.fail("{} has {} indices, which is no multiple of three", what, c.count);
    }
    const bool fits = c.filter == "NONE" || (vertices && c.filter == "EXPONENTIAL") ||
                      (vertices && c.filter == "QUATERNION" && c.stride == 8) ||
                      (vertices && c.filter == "OCTAHEDRAL" && (c.stride == 4 || c.stride == 8));
    if (!fits) {
        source.fail(
            "{} has the filter \"{}\", which does not go with mode {} and {} bytes an element",
            what, c.filter, c.mode, c.stride);
    }
    if (c.count > most_bytes(c) / c.stride) {
        source.fail("{} has {} compressed bytes, too few for {} elements of {} bytes", what,
                    c.bytes.size(), c.count, c.stride);
    }
    return c;
}

std::vector<unsigned char> decode(const GltfSource& source, const Compressed& c,
                                  const std::string& what) {
    std::vector<unsigned char> bytes(c.count * c.stride);
    const unsigned char* from = c.bytes.data();
    const std::size_t size = c.bytes.size();
    const int result =
        c.mode == "ATTRIBUTES"
            ? meshopt_decodeVertexBuffer(bytes.data(), c.count, c.stride, from, size)
        : c.mode == "TRIANGLES"
            ? meshopt_decodeIndexBuffer(bytes.data(), c.count, c.stride, from, size)
            : meshopt_decodeIndexSequence(bytes.data(), c.count, c.stride, from, size);
    if (result != 0) {
        source.fail("{} has compressed data that is damaged, or not for {} elements of {} bytes",
                    what, c.count, c.stride);
    }
    if (c.filter == "OCTAHEDRAL") {
        meshopt_decodeFilterOct(bytes.data(), c.count, c.stride);
    } else if (c.filter == "QUATERNION") {
        meshopt_decodeFilterQuat(bytes.data(), c.count, c.stride);
    } else if (c.filter == "EXPONENTIAL") {
        meshopt_decodeFilterExp(bytes.data(), c.count, c.stride);
    }
    return bytes;
}

} // namespace

void decompress_meshopt(GltfSource& source) {
    for (std::size_t i = 0; i < source.model.bufferViews.size(); ++i) {
        const nlohmann::json* extension =
            find_extension(find_element(source, "bufferViews", i), meshopt_extension);
        if (!extension) {
            continue;
        }
        const std::string what = fmt::format("the compressed buffer view {}", i);
        const Compressed compressed = open_compressed(source, *extension, what);
        std::vector<unsigned char> bytes = decode(source, compressed, what);
        tinygltf::BufferView& view = source.model.bufferViews[i];
        view.byteOffset = 0;
        view.byteLength = bytes.size();
        // Indices are read without a stride.
        view.byteStride = compressed.mode == "ATTRIBUTES" ? compressed.stride : 0;
        view.buffer = add_buffer(source, std::move(bytes));
    }
}

#endif

} // namespace argand
