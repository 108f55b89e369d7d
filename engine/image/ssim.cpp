#include "image/metrics.hpp"
#include "image/srgb.hpp"
#include <algorithm>
#include <cmath>
#include <vector>

namespace argand {

namespace {

constexpr int window_radius = 5;
constexpr double sigma = 1.5;
constexpr double c1 = 0.01 * 0.01; // (K·L)² with L = 1, the range of the encoded luminance
constexpr double c2 = 0.03 * 0.03;

struct Plane {
    int width = 0, height = 0;
    std::vector<double> values;
};

std::vector<double> gaussian(int radius) {
    std::vector<double> weights;
    double sum = 0;
    for (int i = -radius; i <= radius; ++i) {
        weights.push_back(std::exp(-0.5 * i * i / (sigma * sigma)));
        sum += weights.back();
    }
    for (double& weight : weights) {
        weight /= sum; // the sum is at least 1, the weight of the middle
    }
    return weights;
}

/// Radius of the longest window that fits into a side; windows have odd lengths.
int fitting_radius(int side) { return std::min(window_radius, (side - 1) / 2); }

Plane filter_rows(const Plane& in, const std::vector<double>& weights) {
    const int taps = static_cast<int>(weights.size());
    Plane out{in.width - taps + 1, in.height, {}};
    out.values.reserve(static_cast<std::size_t>(out.width) * static_cast<std::size_t>(out.height));
    for (int y = 0; y < out.height; ++y) {
        const double* row = in.values.data() + static_cast<std::ptrdiff_t>(y) * in.width;
        for (int x = 0; x < out.width; ++x) {
            double sum = 0;
            for (int i = 0; i < taps; ++i) {
                sum += weights[static_cast<std::size_t>(i)] * row[x + i];
            }
            out.values.push_back(sum);
        }
    }
    return out;
}

Plane transposed(const Plane& in) {
    Plane out{in.height, in.width, std::vector<double>(in.values.size())};
    for (int y = 0; y < in.height; ++y) {
        for (int x = 0; x < in.width; ++x) {
            out.values[static_cast<std::size_t>(x) * static_cast<std::size_t>(in.height) +
                       static_cast<std::size_t>(y)] =
                in.values[static_cast<std::size_t>(y) * static_cast<std::size_t>(in.width) +
                          static_cast<std::size_t>(x)];
        }
    }
    return out;
}

/// Gaussian mean at every position where the window fits. The result is transposed, which does not
/// change the mean over all positions.
Plane local_mean(const Plane& in) {
    const Plane rows = filter_rows(in, gaussian(fitting_radius(in.width)));
    return filter_rows(transposed(rows), gaussian(fitting_radius(in.height)));
}

Plane displayed(const Image& image) {
    Plane plane{image.width, image.height, {}};
    plane.values.reserve(image.pixels.size());
    for (const glm::vec3& pixel : image.pixels) {
        plane.values.push_back(srgb_encode(luminance(pixel)));
    }
    return plane;
}

Plane product(const Plane& a, const Plane& b) {
    Plane out = a;
    for (std::size_t i = 0; i < out.values.size(); ++i) {
        out.values[i] *= b.values[i];
    }
    return out;
}

} // namespace

double ssim(const Image& a, const Image& b) {
    const Plane x = displayed(a), y = displayed(b);
    const Plane mean_x = local_mean(x), mean_y = local_mean(y);
    const Plane mean_xx = local_mean(product(x, x)), mean_yy = local_mean(product(y, y));
    const Plane mean_xy = local_mean(product(x, y));
    double sum = 0;
    for (std::size_t i = 0; i < mean_x.values.size(); ++i) {
        const double mx = mean_x.values[i], my = mean_y.values[i];
        const double variance_x = mean_xx.values[i] - mx * mx,
                     variance_y = mean_yy.values[i] - my * my;
        const double covariance = mean_xy.values[i] - mx * my;
        // The denominator is positive: one factor is at least c1, the other about c2 or more, since
        // variances are negative by rounding alone.
        sum += (2 * mx * my + c1) * (2 * covariance + c2) /
               ((mx * mx + my * my + c1) * (variance_x + variance_y + c2));
    }
    return sum / static_cast<double>(mean_x.values.size());
}

} // namespace argand
