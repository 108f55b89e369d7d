// Lookup of texels against the image as glTF and OpenGL continue it over the whole plane.
#include "shared/texture.h"

#include <cmath>
#include <gtest/gtest.h>
#include <random>
#include <vector>

namespace argand {
namespace {

TextureRecord texture(std::uint32_t width, std::uint32_t height, std::uint32_t flags) {
    TextureRecord t{};
    t.uu = 1;
    t.vv = 1;
    t.width = width;
    t.height = height;
    t.flags = flags;
    return t;
}

/// Index in 0..size-1 of column or row i of the endless image.
long index_of(long i, long size, std::uint32_t wrap) {
    if (wrap == texture_clamp) {
        return std::clamp(i, 0l, size - 1);
    }
    const long period = wrap == texture_mirror ? 2 * size : size;
    const long j = ((i % period) + period) % period;
    return j < size ? j : 2 * size - 1 - j;
}

/// A texel's value that depends on all of its place.
double value_of(long x, long y) { return std::sin(1.0 + 12.9898 * double(x) + 78.233 * double(y)); }

/// Bilinear interpolation of the endless image, in double precision.
double expected(const TextureRecord& t, double u, double v) {
    const std::uint32_t wrap_u = t.flags & texture_wrap_mask;
    const std::uint32_t wrap_v = (t.flags >> texture_wrap_v) & texture_wrap_mask;
    const double x = (wrap_u == texture_clamp ? std::clamp(u, 0.0, 1.0) : u) * t.width;
    const double y = (wrap_v == texture_clamp ? std::clamp(v, 0.0, 1.0) : v) * t.height;
    const auto texel = [&](long i, long j) {
        return value_of(index_of(i, t.width, wrap_u), index_of(j, t.height, wrap_v));
    };
    if ((t.flags & texture_nearest) != 0) {
        return texel(long(std::floor(x)), long(std::floor(y)));
    }
    double sum = 0;
    for (long j = long(std::floor(y)) - 1; j <= long(std::floor(y)) + 1; ++j) {
        for (long i = long(std::floor(x)) - 1; i <= long(std::floor(x)) + 1; ++i) {
            const double tent_x = std::max(0.0, 1 - std::abs(x - (double(i) + 0.5)));
            const double tent_y = std::max(0.0, 1 - std::abs(y - (double(j) + 0.5)));
            sum += tent_x * tent_y * texel(i, j);
        }
    }
    return sum;
}

double found(const TextureRecord& t, float u, float v) {
    const TexelQuad q = texel_quad(t, vec2(u, v));
    const auto color = [&](uint index) {
        EXPECT_LT(index, t.width * t.height);
        return vec4(float(value_of(long(index % t.width), long(index / t.width))));
    };
    return double(interpolate(q, color(q.t00), color(q.t10), color(q.t01), color(q.t11)).x);
}

constexpr std::uint32_t wraps[] = {texture_repeat, texture_mirror, texture_clamp};

TEST(Texture, InterpolatesTheEndlessImage) {
    std::mt19937 random(1);
    std::uniform_real_distribution<float> anywhere(-3, 4);
    for (const auto& [width, height] :
         {std::pair{1u, 1u}, {2u, 1u}, {3u, 5u}, {7u, 2u}, {64u, 64u}, {1u, 4096u}, {4096u, 1u}}) {
        for (const std::uint32_t wrap_u : wraps) {
            for (const std::uint32_t wrap_v : wraps) {
                const TextureRecord t = texture(width, height, wrap_u | wrap_v << texture_wrap_v);
                for (int i = 0; i < 500; ++i) {
                    const float u = anywhere(random);
                    const float v = anywhere(random);
                    // Places in the image are rounded to 2^-24 of them, and neighbouring texels
                    // differ by up to 2.
                    const double place = std::abs(double(u)) * width + std::abs(double(v)) * height;
                    EXPECT_NEAR(found(t, u, v), expected(t, double(u), double(v)),
                                4 * std::ldexp(place, -24) + 2e-6)
                        << width << "x" << height << ", " << wrap_u << wrap_v << ": " << u << ", "
                        << v;
                }
            }
        }
    }
}

TEST(Texture, TakesTheNearestTexel) {
    std::mt19937 random(2);
    std::uniform_real_distribution<float> anywhere(-3, 4);
    for (const std::uint32_t wrap : wraps) {
        const TextureRecord t =
            texture(4, 8, wrap | wrap << texture_wrap_v | texture_nearest); // exact products
        for (int i = 0; i < 500; ++i) {
            const float u = anywhere(random);
            const float v = anywhere(random);
            if (wrap == texture_clamp && (u >= 1 || v >= 1)) {
                continue; // at the end of the row there is no next texel
            }
            EXPECT_EQ(found(t, u, v), double(float(expected(t, double(u), double(v)))))
                << wrap << ": " << u << ", " << v;
        }
    }
}

TEST(Texture, StaysInTheImageAtSeamsAndFarAway) {
    const float below_one = std::nextafter(1.0f, 0.0f);
    for (const std::uint32_t filter : {0u, texture_nearest}) {
        for (const std::uint32_t wrap : wraps) {
            for (const auto& [width, height] : {std::pair{1u, 4096u}, {3u, 3u}, {65536u, 1u}}) {
                const TextureRecord t =
                    texture(width, height, filter | wrap | wrap << texture_wrap_v);
                for (const float c : {0.0f, -0.0f, 1.0f, below_one, -1.0e-30f, -1.0f, 2.0f, 1.0e9f,
                                      -1.0e9f, 3.4e38f, -3.4e38f, 1.0e-45f}) {
                    const double value = found(t, c, c);
                    EXPECT_TRUE(std::abs(value) <= 1.0001) << c << ": " << value;
                }
            }
        }
    }
}

TEST(Texture, TransformsCoordinatesFirst) {
    TextureRecord t = texture(2, 2, 0);
    t.uu = 2;
    t.uv = 3;
    t.u0 = 4;
    t.vu = 5;
    t.vv = 6;
    t.v0 = 7;
    const vec2 uv = transform_uv(t, vec2(10, 100));
    EXPECT_EQ(uv.x, 2 * 10 + 3 * 100 + 4);
    EXPECT_EQ(uv.y, 5 * 10 + 6 * 100 + 7);
    EXPECT_EQ(transform_uv(t, vec2(3e38f, -3e38f)), vec2(0));
}

} // namespace
} // namespace argand
