// What a picture shows, as bytes.
#pragma once

#include "image/files.hpp"

#include <filesystem>
#include <string>

namespace argand::testing {

/// The names and samples of a picture's layers, without the command that made it.
inline std::string picture_bytes(const std::filesystem::path& file) {
    std::string bytes;
    for (const Layer& layer : read_image(file)) {
        bytes += layer.name + " ";
        bytes.append(reinterpret_cast<const char*>(layer.image.pixels.data()),
                     layer.image.pixels.size() * sizeof(glm::vec3));
    }
    return bytes;
}

} // namespace argand::testing
