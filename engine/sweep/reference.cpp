#include "sweep/reference.hpp"

#include "base/clock.hpp"
#include "base/error.hpp"
#include "image/exr.hpp"
#include "image/files.hpp"
#include "image/mean.hpp"
#include "image/metrics.hpp"
#include "methods/method_info.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace argand {

namespace {

// Samples per pixel of each image of the pair in the first round. Later rounds double them.
constexpr double first_samples = 16;
// Seed of the reference's first round. Settings use other seeds.
constexpr std::uint32_t first_seed = 0x80000000u;

/// relMSE of the mean of two images, from their difference.
double own_error_of(const Image& a, const Image& b) {
    return rel_variance(std::array{a, b}, a, b) / 2;
}

double least_error(std::span<const Image> pilots, const Reference& reference) {
    double least = std::numeric_limits<double>::infinity();
    for (const Image& pilot : pilots) {
        least = std::min(least, rel_mse(pilot, reference.a, reference.b));
    }
    return least;
}

/// Adds an image of `samples` samples to a mean of `before` samples.
Image with_more(const Image& mean, double before, const Image& more, double samples) {
    return before > 0 ? weighted_mean(mean, before, more, samples) : more;
}

} // namespace

Image Reference::mean() const { return mean_of(a, b); }

double least_error_of(const Reference& reference) {
    if (!reference.own_error) {
        return rounding_error;
    }
    double sum = 0, squares = 0;
    for (const double x :
         rel_products(reference.a, reference.b, reference.a, reference.b, reference.mean())) {
        sum += x;
        squares += x * x;
    }
    const double share = sum > 0 ? std::min(2 * std::sqrt(squares) / sum, 1.0) : 1;
    return std::max(share * *reference.own_error, rounding_error);
}

std::optional<Reference> render_reference(const RenderTrials& render, const RenderSettings& base,
                                          std::span<const Image> pilots, double seconds,
                                          const MethodInfo& method) {
    const Clock::time_point start = Clock::now();
    Reference reference;
    RenderSettings settings = base;
    settings.method = method.name;
    double samples = first_samples, done = 0;
    for (std::uint32_t round = 0;; ++round) {
        settings.samples = static_cast<std::uint32_t>(samples);
        const std::array seeds{first_seed + 2 * round, first_seed + 2 * round + 1};
        const double before = seconds_since(start);
        const std::optional<Trials> pair = render(settings, seeds);
        if (!pair) {
            return std::nullopt;
        }
        reference.a = with_more(reference.a, done, pair->trials[0].picture, samples);
        reference.b = with_more(reference.b, done, pair->trials[1].picture, samples);
        done += samples;
        reference.samples = static_cast<std::uint64_t>(2 * done);
        reference.own_error = own_error_of(reference.a, reference.b);
        if (*reference.own_error <= reference_share * least_error(pilots, reference)) {
            return reference;
        }
        // Doubles the samples, as far as time allows.
        const double round_seconds = std::max(seconds_since(start) - before, 1e-6);
        samples =
            std::floor(samples * std::min(2.0, (seconds - seconds_since(start)) / round_seconds));
        if (samples < 1) {
            return reference;
        }
    }
}

Reference read_reference(const std::vector<std::filesystem::path>& files, int width, int height) {
    std::vector<Image> images;
    for (const std::filesystem::path& file : files) {
        const std::vector<Layer> layers = read_image(file);
        const Image* image = find_layer(layers, "");
        if (!image) {
            fail("reading the reference '{}': it has no channels R, G, B", file.string());
        }
        if (image->width != width || image->height != height) {
            fail("reading the reference '{}': it has {} × {} pixels; give --size {}x{}",
                 file.string(), image->width, image->height, image->width, image->height);
        }
        images.push_back(*image);
    }
    Reference reference{.a = images.front(), .b = images.back()};
    if (images.size() > 1) {
        reference.own_error = own_error_of(reference.a, reference.b);
    }
    return reference;
}

void write_reference(const std::filesystem::path& file, const Reference& reference) {
    write_exr(file, std::array{Layer{"", reference.mean()}, Layer{"a", reference.a},
                               Layer{"b", reference.b}});
}

Reference reread_reference(const std::filesystem::path& file) {
    std::vector<Layer> layers;
    try {
        layers = read_exr(file);
    } catch (const Error& error) {
        fail("{}; remove it to render it again", error.what());
    }
    const Image* a = find_layer(layers, "a");
    const Image* b = find_layer(layers, "b");
    if (!a || !b) {
        fail("reading the reference '{}': no sweep has written it; remove it to render it again",
             file.string());
    }
    return {.a = *a, .b = *b};
}

} // namespace argand
