#include "scene/gltf_compression.hpp"

#include "scene/gltf_value.hpp"

#include <utility>

namespace argand {

const char* missing_package(std::string_view extension) {
#ifndef ARGAND_HAVE_MESHOPTIMIZER
    if (extension == meshopt_extension) {
        return "libmeshoptimizer-dev";
    }
#endif
#ifndef ARGAND_HAVE_DRACO
    if (extension == draco_extension) {
        return "libdraco-dev";
    }
#endif
    static_cast<void>(extension);
    return nullptr;
}

std::span<const std::uint8_t> bytes_of_buffer(const GltfSource& source, std::size_t buffer,
                                              std::size_t offset, std::size_t length,
                                              const std::string& what) {
    if (buffer >= source.model.buffers.size()) {
        source.fail("{} refers to buffer {}, which does not exist", what, buffer);
    }
    const std::vector<unsigned char>& bytes = source.model.buffers[buffer].data;
    if (offset > bytes.size() || length > bytes.size() - offset) {
        source.fail("{} ({} bytes at {}) goes past the {} bytes of buffer {}", what, length, offset,
                    bytes.size(), buffer);
    }
    return std::span(bytes).subspan(offset, length);
}

std::size_t size_in_extension(const GltfSource& source, const nlohmann::json& object,
                              const char* key, std::optional<std::size_t> otherwise,
                              const std::string& what) {
    const nlohmann::json* value = find_member(&object, key);
    if (!value && otherwise) {
        return *otherwise;
    }
    constexpr std::uint64_t largest = std::uint64_t(1) << 53;
    if (!value || !value->is_number_unsigned() || value->get<std::uint64_t>() > largest) {
        source.fail("{} has no \"{}\" that is an integer from 0 to 2^53", what, key);
    }
    return value->get<std::size_t>();
}

int add_buffer(GltfSource& source, std::vector<unsigned char> bytes) {
    tinygltf::Buffer buffer;
    buffer.data = std::move(bytes);
    source.model.buffers.push_back(std::move(buffer));
    return static_cast<int>(source.model.buffers.size()) - 1;
}

void decompress(GltfSource& source) {
    decompress_meshopt(source); // Draco's data may lie in such views
    decompress_draco(source);
}

} // namespace argand
