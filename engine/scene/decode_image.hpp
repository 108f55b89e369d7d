#pragma once

#include "scene/texture.hpp"

#include <cstdint>
#include <span>
#include <string>

namespace argand {

/// Most texels of one image, and of all images of a scene together.
inline constexpr std::uint64_t most_texels = std::uint64_t{1} << 26;
inline constexpr std::uint64_t most_texels_of_scene = std::uint64_t{1} << 28;

/// Decodes a PNG or JPEG file to four bytes a texel. Samples of 16 bits lose the lower eight; grey
/// becomes red, green and blue; what has no alpha gets 255. Throws Error, with a message that says
/// what is wrong with the image, if it is neither, damaged, cut short or larger than most_texels.
TextureImage decode_image(std::span<const std::uint8_t> bytes, const std::string& name);

} // namespace argand
