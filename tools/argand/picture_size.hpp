#pragma once

#include <string>

namespace argand {

struct PictureSize {
    int width, height;
};

/// Reads "WIDTHxHEIGHT"; throws UsageError if it is anything else.
PictureSize parse_picture_size(const std::string& size);

} // namespace argand
