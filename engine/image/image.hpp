#pragma once

#include <glm/glm.hpp>
#include <string>
#include <vector>

namespace argand {

/// Linear RGB pixels in rows from the top left.
struct Image {
    int width = 0;
    int height = 0;
    std::vector<glm::vec3> pixels; ///< width × height
};

/// Named pictures of one size that are kept in one OpenEXR file: "" is the whole picture (channels
/// R, G, B), any other name a layer (channels NAME.R, NAME.G, NAME.B).
struct Layer {
    std::string name;
    Image image;
};

} // namespace argand
