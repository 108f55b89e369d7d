#pragma once

#include "scene/texture.hpp"

#include <cstdint>
#include <vector>

namespace argand {

/// The mip levels above an image whose colours are encoded by sRGB's curve, as
/// shared/texture.h describes them. Their mean is that of the image to single precision, whatever
/// its size.
std::vector<std::uint32_t> mip_words(const TextureImage& image);

/// How many words these are.
std::uint64_t mip_word_count(const TextureImage& image);

} // namespace argand
