#pragma once

#include "scene/texture.hpp"

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

namespace argand {

/// Finds the darkest and brightest texels of parts of an image.
class TexelRange {
public:
    struct Range {
        glm::u8vec4 low{255}, high{0}; ///< in each channel
    };

    explicit TexelRange(const TextureImage& image);

    /// Of the texels that lookups by `texture` at places from `from` to `to` read. Places are in
    /// texels; they may lie outside the image and are wrapped.
    Range within(const glm::dvec2& from, const glm::dvec2& to, const Texture& texture) const;

private:
    struct Level {
        std::uint32_t width = 0, height = 0;
        std::vector<Range> texels;
    };
    Range at(std::uint32_t level, std::uint32_t x, std::uint32_t y) const;

    const TextureImage& image_;
    std::vector<Level> levels_; ///< each of half the size of the one before, rounded up
};

} // namespace argand
