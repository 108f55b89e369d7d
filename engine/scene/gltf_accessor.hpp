#pragma once

#include "scene/gltf_source.hpp"
#include <cstddef>
#include <cstdint>

namespace argand {

/// A checked view of an accessor's elements: every element that is read lies within its buffer.
struct GltfAccessor {
    const std::uint8_t* data = nullptr; ///< element 0; null: all elements are zero
    std::size_t stride = 0;             ///< bytes
    std::size_t count = 0;
    int component_type = 0;
    int components = 0;
    bool normalized = false;
    // Elements that replace those above, their numbers strictly increasing.
    const std::uint8_t* sparse_indices = nullptr;
    const std::uint8_t* sparse_values = nullptr;
    std::size_t sparse_count = 0;
    int sparse_index_type = 0;
};

/// Opens accessor `index`. `what` names it in messages ("the positions of mesh 3"). Error if it
/// does not exist, is of an unknown type, or does not lie within its buffer.
GltfAccessor open_accessor(const GltfSource& source, int index, const std::string& what);

/// Component `component` of element `element`; normalised integers as glTF 2.0, section 3.11 says.
double read_component(const GltfAccessor& accessor, std::size_t element, int component);

inline glm::dvec3 read_vec3(const GltfAccessor& accessor, std::size_t element) {
    return {read_component(accessor, element, 0), read_component(accessor, element, 1),
            read_component(accessor, element, 2)};
}

/// An unsigned integer; the component type must be one.
std::uint32_t read_index(const GltfAccessor& accessor, std::size_t element);

} // namespace argand
