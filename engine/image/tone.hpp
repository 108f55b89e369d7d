#pragma once

#include "image/image.hpp"

#include <cstdint>
#include <optional>
#include <string_view>

namespace argand {

/// Curves that bring linear radiance into [0, 1] before a PNG is encoded.
/// - linear: none; what exceeds 1 is clamped in each channel.
/// - neutral: Khronos PBR Neutral. Colours below 0.8 keep hue and saturation, and are darker by at
///   most 0.04, the reflection of a dielectric at normal incidence. Brighter ones are compressed
///   towards 1 and lose saturation.
/// - filmic: the curve that Narkowicz (2015) fitted to ACES, x (2.51 x + 0.03) / (x (2.43 x + 0.59)
///   + 0.14) in each channel: dark colours gain contrast, bright ones fade towards white.
enum class Tone : std::uint8_t { linear, neutral, filmic };

/// The curve of that name, or none.
std::optional<Tone> find_tone(std::string_view name);
std::string_view name_of(Tone tone);

/// The colour on the curve, in [0, 1]. Negative components and NaN count as 0, infinite ones as
/// very large.
glm::dvec3 apply_tone(Tone tone, const glm::dvec3& color);

/// Stops that bring the geometric mean of the pixels' luminance to 0.18, the "key" of Reinhard et
/// al. 2002 (equations 1 and 2), in [-100, 100]. Only pixels whose luminance is positive and finite
/// count, so a black background does not; 0 if there are none.
double automatic_exposure(const Image& image);

} // namespace argand
