#pragma once

#include <glm/glm.hpp>
#include <string>
#include <vector>

namespace argand {

/// Linear RGB pixels, row by row from the top, each row from the left.
struct Image {
    int width = 0;
    int height = 0;
    std::vector<glm::vec3> pixels; ///< width × height
};

/// A named image. An OpenEXR file holds layers of one size: "" is the whole picture (channels R, G,
/// B), any other name a part of it (channels NAME.R, NAME.G, NAME.B).
struct Layer {
    std::string name;
    Image image;
    std::string channels = "RGB"; ///< a letter for each component that the layer has
};

} // namespace argand
