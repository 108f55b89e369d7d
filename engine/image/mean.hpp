#pragma once

#include "image/image.hpp"

#include <span>

namespace argand {

/// Pixel by pixel, of one or more pictures of one size.
Image mean_of(std::span<const Image> images);
inline Image mean_of(const Image& a, const Image& b) {
    const Image both[] = {a, b};
    return mean_of(both);
}

} // namespace argand
