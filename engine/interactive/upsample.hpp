#pragma once

#include "image/image.hpp"

namespace argand {

/// The image in another size: bilinear between the middles of its pixels. `width` and `height` are
/// positive.
Image upsampled(const Image& image, int width, int height);

} // namespace argand
