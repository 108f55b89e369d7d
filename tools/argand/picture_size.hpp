#pragma once

#include <string>

namespace argand {

struct PictureSize {
    int width, height;
};

/// Parses "WIDTHxHEIGHT", each from 1 to 32,768. Throws UsageError on anything else.
PictureSize parse_picture_size(const std::string& size);

} // namespace argand
