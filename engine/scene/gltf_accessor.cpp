#include "scene/gltf_accessor.hpp"

#include <algorithm>
#include <cstring>

namespace argand {
namespace {

// An accessor without data is all zeros, so a few bytes of JSON could request any amount of memory.
// This bounds it.
constexpr std::size_t most_zeros = std::size_t(1) << 22;

std::size_t component_size(int type) {
    switch (type) {
    case TINYGLTF_COMPONENT_TYPE_BYTE:
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
        return 1;
    case TINYGLTF_COMPONENT_TYPE_SHORT:
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
        return 2;
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
    case TINYGLTF_COMPONENT_TYPE_FLOAT:
        return 4;
    default:
        return 0; // glTF has no other component type
    }
}

int component_count(int type) {
    switch (type) {
    case TINYGLTF_TYPE_SCALAR:
        return 1;
    case TINYGLTF_TYPE_VEC2:
        return 2;
    case TINYGLTF_TYPE_VEC3:
        return 3;
    case TINYGLTF_TYPE_VEC4:
        return 4;
    case TINYGLTF_TYPE_MAT4:
        return 16; // of floating-point numbers only, whose columns need no padding
    default:
        return 0; // glTF's other matrices are not used
    }
}

template <class T> T load(const std::uint8_t* from) {
    T value;
    std::memcpy(&value, from, sizeof(T));
    return value;
}

std::uint32_t load_index(const std::uint8_t* from, int type) {
    switch (type) {
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
        return *from;
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
        return load<std::uint16_t>(from);
    default:
        return load<std::uint32_t>(from);
    }
}

/// Elements of a buffer view: `count` of them, `size` bytes each, `stride` bytes apart.
struct ElementRange {
    std::size_t offset, count, size, stride;
};

/// Address of the first element. Checks that all of them lie within view and buffer.
const std::uint8_t* locate(const GltfSource& source, int view_index, const ElementRange& range,
                           const std::string& what) {
    const tinygltf::Model& model = source.model;
    if (view_index < 0 || std::size_t(view_index) >= model.bufferViews.size()) {
        source.fail("{} refer to buffer view {}, which does not exist", what, view_index);
    }
    const tinygltf::BufferView& view = model.bufferViews[std::size_t(view_index)];
    if (view.buffer < 0 || std::size_t(view.buffer) >= model.buffers.size()) {
        source.fail("buffer view {} refers to buffer {}, which does not exist", view_index,
                    view.buffer);
    }
    const std::vector<unsigned char>& bytes = model.buffers[std::size_t(view.buffer)].data;
    if (view.byteLength > bytes.size() || view.byteOffset > bytes.size() - view.byteLength) {
        source.fail("buffer view {} ({} bytes at {}) goes past the {} bytes of buffer {}",
                    view_index, view.byteLength, view.byteOffset, bytes.size(), view.buffer);
    }
    if (range.count == 0) {
        return nullptr;
    }
    // offset + stride·(count − 1) + size ≤ byteLength, in a form that cannot overflow.
    if (range.offset > view.byteLength || range.size > view.byteLength - range.offset ||
        range.count - 1 > (view.byteLength - range.offset - range.size) / range.stride) {
        source.fail(
            "{} ({} elements, {} bytes apart, at {}) go past the {} bytes of buffer view {}", what,
            range.count, range.stride, range.offset, view.byteLength, view_index);
    }
    return bytes.data() + view.byteOffset + range.offset;
}

void open_sparse(const GltfSource& source, const tinygltf::Accessor& accessor, GltfAccessor& view,
                 const std::string& what) {
    const auto& sparse = accessor.sparse;
    view.sparse_index_type = sparse.indices.componentType;
    if (view.sparse_index_type != TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE &&
        view.sparse_index_type != TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT &&
        view.sparse_index_type != TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT) {
        source.fail("{} have sparse indices of component type {}, which is not an unsigned integer",
                    what, view.sparse_index_type);
    }
    if (sparse.count < 0 || std::size_t(sparse.count) > view.count) {
        source.fail("{} replace {} of {} elements", what, sparse.count, view.count);
    }
    view.sparse_count = std::size_t(sparse.count);
    const std::size_t index_size = component_size(view.sparse_index_type);
    const std::size_t size = component_size(view.component_type) * std::size_t(view.components);
    view.sparse_indices = locate(
        source, sparse.indices.bufferView,
        {std::size_t(sparse.indices.byteOffset), view.sparse_count, index_size, index_size}, what);
    view.sparse_values =
        locate(source, sparse.values.bufferView,
               {std::size_t(sparse.values.byteOffset), view.sparse_count, size, size}, what);
    std::uint32_t previous = 0;
    for (std::size_t i = 0; i < view.sparse_count; ++i) {
        const std::uint32_t index =
            load_index(view.sparse_indices + i * index_size, view.sparse_index_type);
        if (index >= view.count || (i > 0 && index <= previous)) {
            source.fail("{} have sparse indices that do not increase from 0 to below {}", what,
                        view.count);
        }
        previous = index;
    }
}

const std::uint8_t* find_element(const GltfAccessor& accessor, std::size_t element) {
    const std::size_t index_size = component_size(accessor.sparse_index_type);
    std::size_t low = 0;
    std::size_t high = accessor.sparse_count;
    while (low < high) {
        const std::size_t middle = low + (high - low) / 2;
        const std::uint32_t index =
            load_index(accessor.sparse_indices + middle * index_size, accessor.sparse_index_type);
        if (index == element) {
            const std::size_t size =
                component_size(accessor.component_type) * std::size_t(accessor.components);
            return accessor.sparse_values + middle * size;
        }
        if (index < element) {
            low = middle + 1;
        } else {
            high = middle;
        }
    }
    return accessor.data ? accessor.data + element * accessor.stride : nullptr;
}

} // namespace

GltfAccessor open_accessor(const GltfSource& source, int index, const std::string& what) {
    if (index < 0 || std::size_t(index) >= source.model.accessors.size()) {
        source.fail("{} refer to accessor {}, which does not exist", what, index);
    }
    const tinygltf::Accessor& accessor = source.model.accessors[std::size_t(index)];
    GltfAccessor view;
    view.count = accessor.count;
    view.component_type = accessor.componentType;
    view.components = component_count(accessor.type);
    view.normalized = accessor.normalized;
    const std::size_t size = component_size(view.component_type) * std::size_t(view.components);
    if (size == 0) {
        source.fail("{} have a component type ({}) or a type that glTF does not allow there", what,
                    view.component_type);
    }
    view.stride = size;
    if (accessor.bufferView >= 0) {
        const auto& views = source.model.bufferViews;
        if (std::size_t(accessor.bufferView) < views.size() &&
            views[std::size_t(accessor.bufferView)].byteStride > 0) {
            view.stride = views[std::size_t(accessor.bufferView)].byteStride;
            if (view.stride < size) {
                source.fail("{} are {} bytes each, but buffer view {} puts them {} bytes apart",
                            what, size, accessor.bufferView, view.stride);
            }
        }
        view.data = locate(source, accessor.bufferView,
                           {accessor.byteOffset, view.count, size, view.stride}, what);
    } else if (view.count > most_zeros) {
        source.fail("{} are {} elements without data; at most {} are allowed", what, view.count,
                    most_zeros);
    }
    if (accessor.sparse.isSparse) {
        open_sparse(source, accessor, view, what);
    }
    return view;
}

double read_component(const GltfAccessor& accessor, std::size_t element, int component) {
    const std::uint8_t* from = find_element(accessor, element);
    if (!from) {
        return 0;
    }
    from += std::size_t(component) * component_size(accessor.component_type);
    const bool unit = accessor.normalized;
    switch (accessor.component_type) {
    case TINYGLTF_COMPONENT_TYPE_BYTE: {
        const double value = load<std::int8_t>(from);
        return unit ? std::max(value / 127, -1.0) : value;
    }
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE: {
        const double value = *from;
        return unit ? value / 255 : value;
    }
    case TINYGLTF_COMPONENT_TYPE_SHORT: {
        const double value = load<std::int16_t>(from);
        return unit ? std::max(value / 32767, -1.0) : value;
    }
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT: {
        const double value = load<std::uint16_t>(from);
        return unit ? value / 65535 : value;
    }
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
        return load<std::uint32_t>(from);
    default:
        return load<float>(from);
    }
}

std::uint32_t read_index(const GltfAccessor& accessor, std::size_t element) {
    const std::uint8_t* from = find_element(accessor, element);
    return from ? load_index(from, accessor.component_type) : 0;
}

} // namespace argand
