#include "image/metrics.hpp"
#include "image/pictures.hpp"
#include "image/srgb.hpp"
#include "support/expect_error.hpp"
#include <cmath>
#include <limits>
#include <random>

using namespace argand;
using namespace argand::testing;
using ::testing::AllOf;
using ::testing::HasSubstr;

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

TEST(Metrics, HandComputed) {
    // B's samples are 1, 2, 3 and 0, 4, 2: mean 2, peak 4. A − B is 1, 0, −1 and 2, 0, 0: squares
    // sum to 6.
    const Image b{2, 1, {{1, 2, 3}, {0, 4, 2}}};
    const Image a{2, 1, {{2, 2, 2}, {2, 4, 2}}};
    const Metrics metrics = compare(a, b);
    EXPECT_NEAR(metrics.rel_mse, (1 / 1.04 + 1 / 9.04 + 4 / 0.04) / 6, 1e-12);
    EXPECT_NEAR(metrics.rmse, 1, 1e-12);
    EXPECT_NEAR(metrics.mae, 4.0 / 6, 1e-12);
    EXPECT_NEAR(metrics.psnr, 20 * std::log10(4.0), 1e-12);
    EXPECT_EQ(metrics.mean_a, glm::dvec3(2, 3, 2));
    EXPECT_EQ(metrics.mean_b, glm::dvec3(0.5, 3, 2.5));
}

TEST(Metrics, IdenticalImages) {
    const Image image = noise(23, 17, 4, 3);
    const Metrics metrics = compare(image, image);
    EXPECT_EQ(metrics.rel_mse, 0);
    EXPECT_EQ(metrics.rmse, 0);
    EXPECT_EQ(metrics.mae, 0);
    EXPECT_EQ(metrics.psnr, infinity);
    EXPECT_NEAR(metrics.ssim, 1, 1e-12);
}

TEST(Metrics, RelativeErrorDoesNotDependOnUnits) {
    const Image b = noise(16, 16, 1), a = noise(16, 16, 2);
    const double expected = compare(a, b).rel_mse;
    for (const float scale : {1e-30f, 1e-10f, 1e10f, 1e30f}) {
        Image scaled_a = a, scaled_b = b;
        for (std::size_t i = 0; i < a.pixels.size(); ++i) {
            scaled_a.pixels[i] *= scale;
            scaled_b.pixels[i] *= scale;
        }
        const Metrics metrics = compare(scaled_a, scaled_b);
        EXPECT_NEAR(metrics.rel_mse / expected, 1, 1e-4) << scale;
        EXPECT_TRUE(std::isfinite(metrics.rmse) && metrics.rmse > 0) << scale;
        EXPECT_TRUE(std::isfinite(metrics.psnr)) << scale;
    }
}

TEST(Metrics, BlackReference) {
    const Image black = constant(12, 12, glm::vec3(0));
    const Metrics same = compare(black, black);
    EXPECT_EQ(same.rel_mse, 0);
    EXPECT_EQ(same.psnr, infinity);
    EXPECT_NEAR(same.ssim, 1, 1e-12);
    const Metrics other = compare(constant(12, 12, glm::vec3(0.5f)), black);
    EXPECT_EQ(other.rel_mse, infinity);
    EXPECT_EQ(other.psnr, -infinity);
    EXPECT_NEAR(other.rmse, 0.5, 1e-12);
}

TEST(Metrics, SumsDoNotLoseSmallTerms) {
    // In single precision, adding 1 to the first pixel's 2^25 would change nothing.
    Image b = constant(1000, 100, glm::vec3(1));
    b.pixels[0] = glm::vec3(33554432.0f);
    EXPECT_NEAR(compare(b, b).mean_b.r, (33554432.0 + 99999) / 100000, 1e-9);
}

TEST(Metrics, RefusesSizesAndNonFinitePixels) {
    const Image good = noise(5, 4, 1);
    EXPECT_THAT(error_of([&] { compare(noise(5, 3, 1), good, "a.exr", "b.exr"); }),
                AllOf(HasSubstr("'a.exr' (5 × 3)"), HasSubstr("'b.exr' (5 × 4)")));
    EXPECT_THAT(error_of([&] { compare({}, {}); }), HasSubstr("empty"));
    EXPECT_THAT(error_of([&] { compare(Image{5, 4, {}}, good); }), HasSubstr("empty"));
    for (const float value :
         {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity()}) {
        Image bad = good;
        bad.pixels[13].g = value;
        EXPECT_THAT(error_of([&] { compare(good, bad, "a.exr", "b.exr"); }),
                    AllOf(HasSubstr("(3, 2)"), HasSubstr("'b.exr'"), HasSubstr("not finite")));
        EXPECT_THAT(error_of([&] { compare(bad, good, "a.exr", "b.exr"); }), HasSubstr("'a.exr'"));
        EXPECT_THAT(error_of([&] { difference_picture(good, bad); }), HasSubstr("not finite"));
    }
}

TEST(Metrics, DifferenceImageShowsPlaceAndSign) {
    const Image b = constant(3, 1, glm::vec3(1));
    const Image a{3, 1, {glm::vec3(1), glm::vec3(1.1f), glm::vec3(0.9f)}};
    const Image picture = difference_picture(a, b);
    EXPECT_EQ(picture.pixels[0], glm::vec3(0));
    EXPECT_NEAR(picture.pixels[1].r, 0.1 / std::sqrt(1.01), 1e-6);
    EXPECT_EQ(picture.pixels[1].b, 0);
    EXPECT_NEAR(picture.pixels[2].b, 0.1 / std::sqrt(1.01), 1e-6);
    EXPECT_EQ(picture.pixels[2].r, 0);
    // The colour saturates, and a black reference is allowed.
    EXPECT_EQ(difference_picture(constant(1, 1, glm::vec3(1e30f)), constant(1, 1, glm::vec3(0)))
                  .pixels[0]
                  .r,
              1);
    EXPECT_EQ(difference_picture(b, b).pixels[2], glm::vec3(0));
}

/// SSIM by its definition: each window separately, two-dimensional weights, centred moments.
double plain_ssim(const Image& a, const Image& b) {
    const auto shown = [](const Image& image, int x, int y) {
        const glm::vec3& p = image.pixels[static_cast<std::size_t>(y * image.width + x)];
        const double linear =
            std::min(std::max(0.2126 * p.r + 0.7152 * p.g + 0.0722 * p.b, 0.0), 1.0);
        return linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1 / 2.4) - 0.055;
    };
    const int radius_x = std::min(5, (a.width - 1) / 2), radius_y = std::min(5, (a.height - 1) / 2);
    double total = 0;
    int windows = 0;
    for (int cy = radius_y; cy < a.height - radius_y; ++cy) {
        for (int cx = radius_x; cx < a.width - radius_x; ++cx) {
            double weights = 0, mean_a = 0, mean_b = 0, aa = 0, bb = 0, ab = 0;
            for (int pass = 0; pass < 2; ++pass) {
                for (int dy = -radius_y; dy <= radius_y; ++dy) {
                    for (int dx = -radius_x; dx <= radius_x; ++dx) {
                        const double w = std::exp(-(dx * dx + dy * dy) / (2 * 1.5 * 1.5));
                        const double va = shown(a, cx + dx, cy + dy),
                                     vb = shown(b, cx + dx, cy + dy);
                        if (pass == 0) {
                            weights += w;
                            mean_a += w * va;
                            mean_b += w * vb;
                        } else {
                            aa += w * (va - mean_a) * (va - mean_a);
                            bb += w * (vb - mean_b) * (vb - mean_b);
                            ab += w * (va - mean_a) * (vb - mean_b);
                        }
                    }
                }
                if (pass == 0) {
                    mean_a /= weights;
                    mean_b /= weights;
                }
            }
            total +=
                (2 * mean_a * mean_b + 1e-4) * (2 * ab / weights + 9e-4) /
                ((mean_a * mean_a + mean_b * mean_b + 1e-4) * (aa / weights + bb / weights + 9e-4));
            ++windows;
        }
    }
    return total / windows;
}

TEST(Ssim, AgreesWithThePlainDefinition) {
    const int sizes[][2] = {{1, 1},   {2, 1},   {1, 9},   {5, 30},
                            {10, 10}, {11, 11}, {12, 13}, {40, 23}};
    for (const auto& [width, height] : sizes) {
        const Image b = noise(width, height, 5, 1.2f); // some values are clamped
        Image a = b;
        const Image other = noise(width, height, 6, 0.4f);
        for (std::size_t i = 0; i < a.pixels.size(); ++i) {
            a.pixels[i] += other.pixels[i] - 0.2f;
        }
        EXPECT_NEAR(ssim(a, b), plain_ssim(a, b), 1e-10) << width << " × " << height;
        EXPECT_NEAR(ssim(b, b), 1, 1e-10) << width << " × " << height;
        EXPECT_NEAR(ssim(a, b), ssim(b, a), 1e-12);
    }
}

TEST(Ssim, ConstantImagesHaveAClosedForm) {
    // Without variance, SSIM is (2·x·y + C1) / (x² + y² + C1) of the encoded values, here 0.25 and
    // 0.75.
    const auto x = static_cast<float>(srgb_decode(0.25)), y = static_cast<float>(srgb_decode(0.75));
    const double expected = (2 * 0.25 * 0.75 + 1e-4) / (0.25 * 0.25 + 0.75 * 0.75 + 1e-4);
    EXPECT_NEAR(ssim(constant(20, 15, glm::vec3(x)), constant(20, 15, glm::vec3(y))), expected,
                1e-6);
}

TEST(Ssim, FallsWithNoise) {
    const Image b = noise(64, 64, 8);
    double last = 1;
    for (const float amount : {0.05f, 0.2f, 0.8f}) {
        Image a = b;
        const Image other = noise(64, 64, 9);
        for (std::size_t i = 0; i < a.pixels.size(); ++i) {
            a.pixels[i] = glm::mix(b.pixels[i], other.pixels[i], amount);
        }
        const double value = ssim(a, b);
        EXPECT_LT(value, last);
        last = value;
    }
}

TEST(Metrics, VarianceHasTheUnitOfRelMse) {
    const std::vector<Image> images{constant(3, 2, glm::vec3(1)), constant(3, 2, glm::vec3(3))};
    const Image low = constant(3, 2, glm::vec3(1.5f)), high = constant(3, 2, glm::vec3(2.5f));
    EXPECT_NEAR(rel_variance(images, low, high), 2 / (4 + 0.01 * 4), 1e-12);
    EXPECT_THROW(rel_variance(std::span(images).first(1), low, high), Error);
    EXPECT_THROW(rel_variance(images, low, constant(2, 3, glm::vec3(1))), Error);
}

TEST(Metrics, ErrorExcludesTheNoiseOfTheReferences) {
    // The image is off by 0.1 everywhere; its two references are noisy.
    std::mt19937 random(3);
    std::normal_distribution<float> noise(0, 0.04f);
    Image truth{64, 64, {}};
    Image a = truth;
    Image b = truth;
    Image off = truth;
    for (int i = 0; i < 64 * 64; ++i) {
        const glm::vec3 value(1, 2, 0.5f);
        off.pixels.push_back(value * 1.1f);
        a.pixels.push_back(value + value * noise(random));
        b.pixels.push_back(value + value * noise(random));
    }
    EXPECT_NEAR(rel_mse(off, a, b), 0.01, 0.001);
    EXPECT_GT(compare(off, a).rel_mse, 0.0111);
    EXPECT_EQ(rel_mse(a, a, b), 0);
    EXPECT_THROW(rel_mse(truth, a, b), Error);
}

} // namespace
