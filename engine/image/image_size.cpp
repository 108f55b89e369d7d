#include "image/image_size.hpp"

#include "base/error.hpp"

namespace argand {

void check_size_to_write(const std::filesystem::path& path, const Image& image) {
    if (image.width < 1 || image.height < 1 || image.width > longest_side ||
        image.height > longest_side) {
        fail("cannot write '{}': a picture of {} × {} pixels; each side must be 1 to {}",
             path.string(), image.width, image.height, longest_side);
    }
    if (image.pixels.size() !=
        static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height)) {
        fail("cannot write '{}': the picture has {} pixels but its size is {} × {}", path.string(),
             image.pixels.size(), image.width, image.height);
    }
}

} // namespace argand
