#include "interactive/upsample.hpp"

#include <algorithm>
#include <cmath>

namespace argand {

namespace {

/// Between which two pixels a point lies, and how near to the second one.
struct Between {
    int first = 0, second = 0;
    float share = 0;
};

Between between(int at, int count, int of) {
    const float position =
        (static_cast<float>(at) + 0.5f) * static_cast<float>(of) / static_cast<float>(count) - 0.5f;
    const float low = std::floor(position);
    const int first = static_cast<int>(low);
    return {std::clamp(first, 0, of - 1), std::clamp(first + 1, 0, of - 1), position - low};
}

} // namespace

Image upsampled(const Image& image, int width, int height) {
    if (image.width == width && image.height == height) {
        return image;
    }
    Image result{.width = width, .height = height, .pixels = {}};
    result.pixels.reserve(static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
    for (int y = 0; y < height; ++y) {
        const Between v = between(y, height, image.height);
        const auto row = [&](int line) {
            return image.pixels.begin() + static_cast<std::ptrdiff_t>(line) * image.width;
        };
        const auto above = row(v.first), below = row(v.second);
        for (int x = 0; x < width; ++x) {
            const Between u = between(x, width, image.width);
            result.pixels.push_back(glm::mix(glm::mix(above[u.first], above[u.second], u.share),
                                             glm::mix(below[u.first], below[u.second], u.share),
                                             v.share));
        }
    }
    return result;
}

} // namespace argand
