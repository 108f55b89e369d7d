#include "image/srgb.hpp"
#include "plot/plot.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>

#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wunused-function"
#pragma GCC diagnostic ignored "-Wsign-compare"
#include <stb_easy_font.h>
#pragma GCC diagnostic pop

namespace argand {

namespace {

constexpr float text_scale = 1.6f;
constexpr float text_height = 7; // of a capital, in units of the font
constexpr std::uint32_t black = 0x222222;

glm::vec3 linear(std::uint32_t color) {
    const auto channel = [&](int shift) {
        return static_cast<float>(srgb_decode((color >> shift & 255) / 255.0));
    };
    return {channel(16), channel(8), channel(0)};
}

/// Paints each pixel of a box as far as `coverage(place of its centre)`, in [0, 1], says.
template <class Coverage>
void paint(Image& image, Place low, Place high, const glm::vec3& color, Coverage coverage) {
    const auto first = [](double value) {
        return std::max(static_cast<int>(std::floor(value)), 0);
    };
    const auto end = [](double value, int side) {
        return std::min(static_cast<int>(std::ceil(value)) + 1, side);
    };
    for (int y = first(low.y); y < end(high.y, image.height); ++y) {
        for (int x = first(low.x); x < end(high.x, image.width); ++x) {
            glm::vec3& pixel =
                image.pixels[static_cast<std::size_t>(y) * static_cast<std::size_t>(image.width) +
                             static_cast<std::size_t>(x)];
            pixel = glm::mix(
                pixel, color,
                static_cast<float>(std::clamp(coverage(Place{x + 0.5, y + 0.5}), 0.0, 1.0)));
        }
    }
}

void draw_rectangle(Image& image, Place low, Place high, const glm::vec3& color) {
    const auto overlap = [](double a, double b, double centre) {
        return std::max(std::min(b, centre + 0.5) - std::max(a, centre - 0.5), 0.0);
    };
    paint(image, low, high, color,
          [&](Place p) { return overlap(low.x, high.x, p.x) * overlap(low.y, high.y, p.y); });
}

/// The plot's lines run along the axes.
void draw_line(Image& image, const PlotLine& line) {
    const double half = 0.5 * line.width;
    draw_rectangle(
        image, {std::min(line.from.x, line.to.x) - half, std::min(line.from.y, line.to.y) - half},
        {std::max(line.from.x, line.to.x) + half, std::max(line.from.y, line.to.y) + half},
        linear(line.color));
}

void draw_disc(Image& image, Place center, double radius, std::uint32_t color, double opacity) {
    paint(image, {center.x - radius, center.y - radius}, {center.x + radius, center.y + radius},
          linear(color), [&](Place p) {
              return opacity * std::clamp(radius + 0.5 - std::hypot(p.x - center.x, p.y - center.y),
                                          0.0, 1.0);
          });
}

void draw_point(Image& image, const PlotPoint& point) {
    if (point.on_front) {
        draw_disc(image, point.place, 7, black, 1);
        draw_disc(image, point.place, 5.5, point.color, 1);
    } else {
        draw_disc(image, point.place, 4, point.color, 0.7);
    }
}

/// A vertex as stb_easy_font leaves it.
struct FontVertex {
    float x, y, z;
    unsigned char color[4];
};

/// The font has the characters of ASCII from the space on.
std::string drawable(std::string text) {
    std::replace_if(
        text.begin(), text.end(), [](char c) { return c < ' ' || c > '~'; }, '?');
    return text;
}

void draw_text(Image& image, const PlotLabel& label) {
    std::string text = drawable(label.text);
    std::vector<FontVertex> vertices(4 * (24 * text.size() + 1));
    const int quads = stb_easy_font_print(0, 0, text.data(), nullptr, vertices.data(),
                                          static_cast<int>(vertices.size() * sizeof(FontVertex)));
    const float width = text_scale * static_cast<float>(stb_easy_font_width(text.data()));
    const double share = label.align == PlotLabel::Align::left     ? 0
                         : label.align == PlotLabel::Align::middle ? 0.5
                                                                   : 1;
    const Place origin{label.place.x - share * width,
                       label.place.y - 0.5 * text_scale * text_height};
    for (int i = 0; i < quads; ++i) {
        const FontVertex& low = vertices[static_cast<std::size_t>(4 * i)];
        const FontVertex& high = vertices[static_cast<std::size_t>(4 * i + 2)];
        draw_rectangle(image, {origin.x + text_scale * low.x, origin.y + text_scale * low.y},
                       {origin.x + text_scale * high.x, origin.y + text_scale * high.y},
                       linear(label.color));
    }
}

} // namespace

Image to_image(const Plot& plot) {
    const auto pixels =
        static_cast<std::size_t>(plot.width) * static_cast<std::size_t>(plot.height);
    Image image{plot.width, plot.height, std::vector<glm::vec3>(pixels, glm::vec3(1))};
    for (const PlotLine& line : plot.lines) {
        draw_line(image, line);
    }
    for (const PlotPoint& point : plot.points) {
        draw_point(image, point);
    }
    for (const PlotLabel& label : plot.labels) {
        draw_text(image, label);
    }
    return image;
}

} // namespace argand
