#include "image/tone.hpp"

#include "image/srgb.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace argand {

namespace {

constexpr std::array<std::pair<std::string_view, Tone>, 3> tones = {
    {{"linear", Tone::linear}, {"neutral", Tone::neutral}, {"filmic", Tone::filmic}}};

/// Bounds a component so that no square of it overflows.
double bounded(double component) { return component > 0 ? std::min(component, 1e30) : 0; }

/// Khronos, "PBR Neutral Specification", 2024.
glm::dvec3 neutral(glm::dvec3 color) {
    constexpr double reflection = 0.04; // of a dielectric with index 1.5, at normal incidence
    constexpr double first_compressed = 0.8 - reflection;
    constexpr double desaturation = 0.15;
    const double least = std::min({color.r, color.g, color.b});
    color -= least < 2 * reflection ? least - least * least / (4 * reflection) : reflection;
    const double peak = std::max({color.r, color.g, color.b});
    if (peak < first_compressed) {
        return color;
    }
    constexpr double rest = 1 - first_compressed;
    const double compressed = 1 - rest * rest / (peak + rest - first_compressed);
    const double grey = 1 - 1 / (desaturation * (peak - compressed) + 1);
    return glm::mix(color * (compressed / peak), glm::dvec3(compressed), grey);
}

double filmic(double x) { return x * (2.51 * x + 0.03) / (x * (2.43 * x + 0.59) + 0.14); }

} // namespace

std::optional<Tone> find_tone(std::string_view name) {
    for (const auto& [of_tone, tone] : tones) {
        if (of_tone == name) {
            return tone;
        }
    }
    return std::nullopt;
}

std::string_view name_of(Tone tone) { return tones[static_cast<std::size_t>(tone)].first; }

glm::dvec3 apply_tone(Tone tone, const glm::dvec3& color) {
    const glm::dvec3 x(bounded(color.r), bounded(color.g), bounded(color.b));
    const glm::dvec3 y = tone == Tone::neutral  ? neutral(x)
                         : tone == Tone::filmic ? glm::dvec3(filmic(x.r), filmic(x.g), filmic(x.b))
                                                : x;
    return glm::clamp(y, 0.0, 1.0);
}

double automatic_exposure(const Image& image) {
    constexpr double key = 0.18, limit = 100;
    double sum = 0;
    double count = 0;
    for (const glm::vec3& pixel : image.pixels) {
        const double of_pixel = luminance(pixel);
        if (of_pixel > 0 && std::isfinite(of_pixel)) {
            sum += std::log2(of_pixel);
            ++count;
        }
    }
    return count > 0 ? std::clamp(std::log2(key) - sum / count, -limit, limit) : 0;
}

} // namespace argand
