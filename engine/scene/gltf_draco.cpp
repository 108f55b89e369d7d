#include "scene/gltf_compression.hpp"

#include "scene/gltf_value.hpp"

#ifdef ARGAND_HAVE_DRACO
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wall"
#pragma GCC diagnostic ignored "-Wextra"
#pragma GCC diagnostic ignored "-Wpedantic"
#pragma GCC diagnostic ignored "-Wshadow"
#include <draco/compression/decode.h>
#pragma GCC diagnostic pop
#endif

#include <algorithm>
#include <cstring>
#include <memory>

namespace argand {

#ifndef ARGAND_HAVE_DRACO

void decompress_draco(GltfSource&) {}

#else

namespace {

/// Most triangles, and most vertices, that a byte of compressed data may stand for. Regular grids,
/// which compress best, reach about a tenth. A short file could demand any amount of memory
/// otherwise.
constexpr std::uint64_t most_per_byte = 1024;

/// Reads the counts in the header of Draco's data (its bit stream specification, sections 3 to 5),
/// which the library would believe.
class Header {
public:
    explicit Header(std::span<const std::uint8_t> bytes) : bytes_(bytes) {}

    /// The largest count that it states; none if it is no header of a mesh.
    std::optional<std::uint64_t> largest_count() {
        constexpr std::uint8_t triangles = 1, sequential = 0, edgebreaker = 1;
        constexpr std::uint16_t has_metadata = 0x8000;
        const bool is_draco = bytes_.size() >= 11 && std::memcmp(bytes_.data(), "DRACO", 5) == 0;
        if (!is_draco || bytes_[7] != triangles || bytes_[8] > edgebreaker) {
            return std::nullopt;
        }
        const bool is_2_2 = bytes_[5] == 2 && bytes_[6] == 2;
        const auto flags = static_cast<std::uint16_t>(bytes_[9] | bytes_[10] << 8);
        // Counts of other versions are laid out otherwise, and metadata comes before them: then
        // the library's own checks have to do.
        if (!is_2_2 || (flags & has_metadata) != 0) {
            return 0;
        }
        at_ = bytes_[8] == sequential ? 11 : 12; // behind the traversal's type
        const std::uint64_t a = number();
        const std::uint64_t b = number();
        return std::max(a, b);
    }

private:
    /// Seven bits a byte, the lowest ones first.
    std::uint64_t number() {
        std::uint64_t value = 0;
        for (int shift = 0; shift < 63 && at_ < bytes_.size(); shift += 7) {
            const std::uint8_t byte = bytes_[at_++];
            value |= static_cast<std::uint64_t>(byte & 0x7f) << shift;
            if ((byte & 0x80) == 0) {
                break;
            }
        }
        return value;
    }

    std::span<const std::uint8_t> bytes_;
    std::size_t at_ = 0;
};

std::unique_ptr<draco::Mesh> decode(const GltfSource& source, std::span<const std::uint8_t> bytes,
                                    const std::string& what) {
    const std::optional<std::uint64_t> count = Header(bytes).largest_count();
    if (!count) {
        source.fail("{} is damaged: it does not begin as a mesh of Draco does", what);
    }
    if (*count > most_per_byte * bytes.size()) {
        source.fail("{} is damaged: its {} bytes are too few for {} triangles or vertices", what,
                    bytes.size(), *count);
    }
    draco::DecoderBuffer buffer;
    buffer.Init(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    draco::Decoder decoder;
    auto decoded = decoder.DecodeMeshFromBuffer(&buffer);
    if (!decoded.ok()) {
        source.fail("{} is damaged: {}", what, one_line(decoded.status().error_msg_string(), 120));
    }
    return std::move(decoded).value();
}

/// The elements of an attribute as an accessor's component type has them, without gaps.
template <class T>
bool convert(const draco::Mesh& mesh, const draco::PointAttribute& attribute,
             std::vector<unsigned char>& bytes) {
    const int components = attribute.num_components();
    const std::size_t size = sizeof(T) * static_cast<std::size_t>(components);
    bytes.resize(mesh.num_points() * size);
    std::vector<T> element(static_cast<std::size_t>(components));
    for (std::uint32_t i = 0; i < mesh.num_points(); ++i) {
        if (!attribute.ConvertValue<T>(attribute.mapped_index(draco::PointIndex(i)),
                                       static_cast<std::int8_t>(components), element.data())) {
            return false;
        }
        std::memcpy(bytes.data() + i * size, element.data(), size);
    }
    return true;
}

bool convert(const draco::Mesh& mesh, const draco::PointAttribute& attribute, int type,
             std::vector<unsigned char>& bytes) {
    switch (type) {
    case TINYGLTF_COMPONENT_TYPE_BYTE:
        return convert<std::int8_t>(mesh, attribute, bytes);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
        return convert<std::uint8_t>(mesh, attribute, bytes);
    case TINYGLTF_COMPONENT_TYPE_SHORT:
        return convert<std::int16_t>(mesh, attribute, bytes);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
        return convert<std::uint16_t>(mesh, attribute, bytes);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
        return convert<std::uint32_t>(mesh, attribute, bytes);
    case TINYGLTF_COMPONENT_TYPE_FLOAT:
        return convert<float>(mesh, attribute, bytes);
    default:
        return false;
    }
}

/// Gives an accessor these bytes, in a view of their own.
void set_data(GltfSource& source, tinygltf::Accessor& accessor, std::vector<unsigned char> bytes) {
    tinygltf::BufferView view;
    view.byteLength = bytes.size();
    view.buffer = add_buffer(source, std::move(bytes));
    source.model.bufferViews.push_back(view);
    accessor.bufferView = static_cast<int>(source.model.bufferViews.size()) - 1;
    accessor.byteOffset = 0;
}

tinygltf::Accessor& accessor_at(GltfSource& source, int index, const std::string& what) {
    if (index < 0 || std::size_t(index) >= source.model.accessors.size()) {
        source.fail("{} goes with accessor {}, which does not exist", what, index);
    }
    return source.model.accessors[std::size_t(index)];
}

void set_indices(GltfSource& source, const draco::Mesh& mesh, int index, const std::string& what) {
    tinygltf::Accessor& accessor = accessor_at(source, index, what);
    const std::size_t count = std::size_t(mesh.num_faces()) * 3;
    if (accessor.count != count || accessor.type != TINYGLTF_TYPE_SCALAR) {
        source.fail("{} has {} indices, but accessor {} states {}", what, count, index,
                    accessor.count);
    }
    std::vector<unsigned char> bytes(count * sizeof(std::uint32_t));
    for (std::uint32_t i = 0; i < mesh.num_faces(); ++i) {
        const draco::Mesh::Face& face = mesh.face(draco::FaceIndex(i));
        const std::uint32_t corners[] = {face[0].value(), face[1].value(), face[2].value()};
        std::memcpy(bytes.data() + i * sizeof(corners), corners, sizeof(corners));
    }
    accessor.componentType = TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT;
    set_data(source, accessor, std::move(bytes));
}

void set_attribute(GltfSource& source, const draco::Mesh& mesh, const std::string& name,
                   const nlohmann::json& id, int index, const std::string& what) {
    const draco::PointAttribute* attribute =
        id.is_number_unsigned() && id.get<std::uint64_t>() <= 0xffffffffu
            ? mesh.GetAttributeByUniqueId(id.get<std::uint32_t>())
            : nullptr;
    if (!attribute) {
        source.fail("{} has no attribute {} for {}", what, one_line(id.dump(-1, ' ', true), 40),
                    one_line(name, 40));
    }
    tinygltf::Accessor& accessor = accessor_at(source, index, what);
    const int components = tinygltf::GetNumComponentsInType(std::uint32_t(accessor.type));
    if (accessor.count != mesh.num_points() || components != attribute->num_components()) {
        source.fail("{} has {} vertices of {} components for {}, but accessor {} states {} of {}",
                    what, mesh.num_points(), attribute->num_components(), one_line(name, 40), index,
                    accessor.count, components);
    }
    std::vector<unsigned char> bytes;
    if (!convert(mesh, *attribute, accessor.componentType, bytes)) {
        source.fail("{} has a {} that does not fit the component type {} of accessor {}", what,
                    one_line(name, 40), accessor.componentType, index);
    }
    set_data(source, accessor, std::move(bytes));
}

void decompress_primitive(GltfSource& source, const tinygltf::Primitive& primitive,
                          const nlohmann::json& extension, const std::string& what) {
    const std::size_t number = size_in_extension(source, extension, "bufferView", {}, what);
    if (number >= source.model.bufferViews.size()) {
        source.fail("{} refers to buffer view {}, which does not exist", what, number);
    }
    const tinygltf::BufferView& view = source.model.bufferViews[number];
    const std::unique_ptr<draco::Mesh> mesh = decode(
        source,
        bytes_of_buffer(source, std::size_t(view.buffer), view.byteOffset, view.byteLength, what),
        what);
    if (primitive.mode != TINYGLTF_MODE_TRIANGLES || primitive.indices < 0) {
        source.fail("{} is not for a list of triangles with indices, as it must be", what);
    }
    set_indices(source, *mesh, primitive.indices, what);
    const nlohmann::json* attributes = find_member(&extension, "attributes");
    if (!attributes || !attributes->is_object()) {
        source.fail("{} has no \"attributes\"", what);
    }
    for (const auto& [name, id] : attributes->items()) {
        const auto accessor = primitive.attributes.find(name);
        if (accessor == primitive.attributes.end()) {
            source.fail("{} has a {} that the primitive lacks", what, one_line(name, 40));
        }
        set_attribute(source, *mesh, name, id, accessor->second, what);
    }
}

} // namespace

void decompress_draco(GltfSource& source) {
    for (std::size_t m = 0; m < source.model.meshes.size(); ++m) {
        const nlohmann::json* primitives =
            find_member(find_element(source, "meshes", m), "primitives");
        for (std::size_t p = 0; p < source.model.meshes[m].primitives.size(); ++p) {
            const nlohmann::json* primitive =
                primitives && primitives->is_array() && p < primitives->size() ? &(*primitives)[p]
                                                                               : nullptr;
            const nlohmann::json* extension = find_extension(primitive, draco_extension);
            if (extension) {
                decompress_primitive(
                    source, source.model.meshes[m].primitives[p], *extension,
                    fmt::format("the compressed data of {}",
                                label("mesh", static_cast<int>(m), source.model.meshes[m].name)));
            }
        }
    }
}

#endif

} // namespace argand
