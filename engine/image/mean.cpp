#include "image/mean.hpp"

namespace argand {

Image mean_of(std::span<const Image> images) {
    Image mean = images.front();
    const float share = 1.0f / static_cast<float>(images.size());
    for (std::size_t i = 0; i < mean.pixels.size(); ++i) {
        for (const Image& image : images.subspan(1)) {
            mean.pixels[i] += image.pixels[i];
        }
        mean.pixels[i] *= share;
    }
    return mean;
}

} // namespace argand
