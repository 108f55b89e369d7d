#pragma once

#include "scene/gltf_source.hpp"
#include <cstddef>
#include <cstdint>

namespace argand {

/// A checked view of an accessor's elements: every element lies within its buffer.
struct GltfAccessor {
    const std::uint8_t* data = nullptr; ///< element 0; null: all elements are zero
    std::size_t stride = 0;             ///< bytes
    std::size_t count = 0;
    int component_type = 0;
    int components = 0;
    bool normalized = false;
    // Elements that replace those in `data`; their indices increase strictly.
    const std::uint8_t* sparse_indices = nullptr;
    const std::uint8_t* sparse_values = nullptr;
    std::size_t sparse_count = 0;
    int sparse_index_type = 0;
};

/// Opens accessor `index`. `what` names it in messages ("the positions of mesh 3"). Throws Error if
/// it does not exist, has an unknown type, or exceeds its buffer.
GltfAccessor open_accessor(const GltfSource& source, int index, const std::string& what);

/// Component `component` of element `element`. Normalised integers are converted as glTF 2.0,
/// section 3.11, defines.
double read_component(const GltfAccessor& accessor, std::size_t element, int component);

inline glm::dvec3 read_vec3(const GltfAccessor& accessor, std::size_t element) {
    return {read_component(accessor, element, 0), read_component(accessor, element, 1),
            read_component(accessor, element, 2)};
}

/// Reads an unsigned integer. The component type must be unsigned.
std::uint32_t read_index(const GltfAccessor& accessor, std::size_t element);

} // namespace argand
