#include "image/metrics.hpp"

#include "base/error.hpp"
#include "image/srgb.hpp"
#include <algorithm>
#include <cmath>
#include <limits>

namespace argand {

namespace {

constexpr double dark_share = 0.01; // of the squared mean; keeps dark pixels from dominating relMSE

void check_finite(const Image& image, std::string_view name) {
    for (std::size_t i = 0; i < image.pixels.size(); ++i) {
        const glm::vec3& p = image.pixels[i];
        if (!std::isfinite(p.r) || !std::isfinite(p.g) || !std::isfinite(p.b)) {
            const auto width = static_cast<std::size_t>(image.width);
            fail("cannot compare: pixel ({}, {}) of '{}' is not finite ({}, {}, {}); render it "
                 "again",
                 i % width, i / width, name, p.r, p.g, p.b);
        }
    }
}

void check_pair(const Image& a, const Image& b, std::string_view name_a, std::string_view name_b) {
    if (a.width != b.width || a.height != b.height) {
        fail("cannot compare '{}' ({} × {}) with '{}' ({} × {}): their sizes differ; render both "
             "at one size",
             name_a, a.width, a.height, name_b, b.width, b.height);
    }
    if (a.pixels.empty() || a.pixels.size() != b.pixels.size()) {
        fail("cannot compare '{}' with '{}': a picture is empty", name_a, name_b);
    }
    check_finite(a, name_a);
    check_finite(b, name_b);
}

glm::dvec3 mean_of(const Image& image) {
    glm::dvec3 sum(0);
    for (const glm::vec3& pixel : image.pixels) {
        sum += glm::dvec3(pixel);
    }
    return sum / static_cast<double>(image.pixels.size());
}

double mean_of_channels(const glm::dvec3& v) { return (v.r + v.g + v.b) / 3; }

/// squared_difference / squared_scale, where 0 / 0 is 0.
double relative(double squared_difference, double squared_scale) {
    if (squared_difference == 0) {
        return 0;
    }
    return squared_scale > 0 ? squared_difference / squared_scale
                             : std::numeric_limits<double>::infinity();
}

/// Mean over pixels and channels of `square(pixel, channel, a, b)`, divided as in relMSE.
template <class Square>
double mean_relative(const Image& reference_a, const Image& reference_b, Square square) {
    const double mean = mean_of_channels(0.5 * (mean_of(reference_a) + mean_of(reference_b)));
    double sum = 0;
    for (std::size_t i = 0; i < reference_a.pixels.size(); ++i) {
        for (int c = 0; c < 3; ++c) {
            const double a = reference_a.pixels[i][c];
            const double b = reference_b.pixels[i][c];
            sum +=
                relative(square(i, c, a, b), 0.25 * (a + b) * (a + b) + dark_share * mean * mean);
        }
    }
    return sum / (3 * static_cast<double>(reference_a.pixels.size()));
}

double decibels(double peak, double rmse) {
    if (rmse == 0) {
        return std::numeric_limits<double>::infinity();
    }
    return peak > 0 ? 20 * std::log10(peak / rmse) : -std::numeric_limits<double>::infinity();
}

} // namespace

double rel_mse(const Image& image, const Image& reference_a, const Image& reference_b) {
    check_pair(image, reference_a, "the picture", "its reference");
    check_pair(reference_b, reference_a, "the second reference", "the first");
    return mean_relative(reference_a, reference_b, [&](std::size_t i, int c, double a, double b) {
        return (image.pixels[i][c] - a) * (image.pixels[i][c] - b);
    });
}

double rel_variance(std::span<const Image> images, const Image& reference_a,
                    const Image& reference_b) {
    if (images.size() < 2) {
        fail("measuring the variance of {} pictures: it takes two; use more seeds", images.size());
    }
    check_pair(reference_b, reference_a, "the second reference", "the first");
    for (const Image& image : images) {
        check_pair(image, reference_a, "the picture", "its reference");
    }
    const auto count = static_cast<double>(images.size());
    return mean_relative(reference_a, reference_b, [&](std::size_t i, int c, double, double) {
        double mean = 0, squares = 0;
        for (const Image& image : images) {
            mean += image.pixels[i][c] / count;
        }
        for (const Image& image : images) {
            squares += (image.pixels[i][c] - mean) * (image.pixels[i][c] - mean);
        }
        return squares / (count - 1);
    });
}

std::vector<double> rel_products(const Image& a, const Image& b, const Image& c, const Image& d,
                                 const Image& reference) {
    for (const Image* image : {&a, &b, &c, &d}) {
        check_pair(*image, reference, "the picture", "its reference");
    }
    const double mean = mean_of_channels(mean_of(reference));
    std::vector<double> products(reference.pixels.size());
    for (std::size_t i = 0; i < products.size(); ++i) {
        for (int k = 0; k < 3; ++k) {
            const double scale = reference.pixels[i][k];
            const double first = a.pixels[i][k] - b.pixels[i][k];
            const double second = c.pixels[i][k] - d.pixels[i][k];
            products[i] += relative(first * second, scale * scale + dark_share * mean * mean) / 3;
        }
    }
    return products;
}

Metrics compare(const Image& a, const Image& b, std::string_view name_a, std::string_view name_b) {
    check_pair(a, b, name_a, name_b);
    Metrics metrics;
    metrics.mean_a = mean_of(a);
    metrics.mean_b = mean_of(b);
    const double mean = mean_of_channels(metrics.mean_b);
    double squares = 0, relatives = 0, absolutes = 0;
    double peak = -std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < b.pixels.size(); ++i) {
        for (int c = 0; c < 3; ++c) {
            const double value = b.pixels[i][c];
            const double d = a.pixels[i][c] - value;
            squares += d * d;
            relatives += relative(d * d, value * value + dark_share * mean * mean);
            absolutes += std::abs(d);
            peak = std::max(peak, value);
        }
    }
    const double count = 3 * static_cast<double>(b.pixels.size());
    metrics.rel_mse = relatives / count;
    metrics.rmse = std::sqrt(squares / count); // a sum of squares is not negative
    metrics.mae = absolutes / count;
    metrics.psnr = decibels(peak, metrics.rmse);
    metrics.ssim = ssim(a, b);
    return metrics;
}

Image difference_picture(const Image& a, const Image& b, std::string_view name_a,
                         std::string_view name_b) {
    check_pair(a, b, name_a, name_b);
    const double mean = mean_of_channels(mean_of(b));
    constexpr glm::dvec3 brighter(1, 0.15, 0), darker(0, 0.15, 1);
    Image result{a.width, a.height, {}};
    result.pixels.reserve(a.pixels.size());
    for (std::size_t i = 0; i < a.pixels.size(); ++i) {
        const double reference = luminance(b.pixels[i]);
        const double d = luminance(a.pixels[i]) - reference;
        const double share =
            std::sqrt(relative(d * d, reference * reference + dark_share * mean * mean));
        result.pixels.emplace_back((d > 0 ? brighter : darker) * std::min(share, 1.0));
    }
    return result;
}

} // namespace argand
