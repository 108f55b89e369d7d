// Trees by which points on textured lamps are chosen, against the texels that the lamps show.
#include "world/texel_trees.hpp"

#include "methods/textured.hpp"
#include "shared/frame.h"
#include "shared/texel_tree.h"
#include "shared/texture.h"
#include "world/texel_range.hpp"

#include <gtest/gtest.h>
#include <random>

namespace argand::testing {
namespace {

std::vector<std::uint32_t> random_texels(std::uint32_t count, double dark, std::mt19937& random) {
    std::uniform_real_distribution<double> unit;
    std::vector<std::uint32_t> texels;
    for (std::uint32_t i = 0; i < count; ++i) {
        const auto code = [&] { return int(255.99 * unit(random)); };
        texels.push_back(unit(random) < dark ? texel(0, 0, 0) : texel(code(), code(), code()));
    }
    return texels;
}

/// Two triangles that show parts of an image with an emissive texture, beside one that does not.
struct Lamp {
    Scene scene;
    std::vector<TextureRecord> records;
    std::vector<std::uint32_t> words = std::vector<std::uint32_t>(srgb_codes, 7u);
    TexelTrees trees;

    Lamp(std::uint32_t width, const std::vector<std::uint32_t>& texels, Wrap wrap, bool nearest,
         const std::array<glm::vec2, 4>& uvs) {
        scene.materials.resize(2);
        add_texture(scene, 1, material_emissive_texture, width, texels, nearest);
        scene.textures[0].wrap_u = scene.textures[0].wrap_v = wrap;
        scene.positions = {{0, 0, 0}, {1, 0, 0}, {0, 2, 0}, {3, 3, 1}};
        scene.uvs.assign(uvs.begin(), uvs.end());
        scene.triangles = {{0, 1, 3}, {0, 1, 2}, {2, 1, 3}};
        scene.triangle_material = {0, 1, 1};
        const std::uint32_t flag = wrap == Wrap::repeat          ? texture_repeat
                                   : wrap == Wrap::clamp_to_edge ? texture_clamp
                                                                 : texture_mirror;
        TextureRecord record{};
        record.uu = record.vv = 1;
        record.width = width;
        record.height = scene.images[0]->height;
        record.flags = flag | flag << texture_wrap_v | (nearest ? texture_nearest : 0u);
        records = {record};
        trees = make_texel_trees(scene, scene.images, records, words);
    }

    /// The colour that the triangle shows at a point.
    glm::dvec3 color(std::uint32_t triangle, const glm::vec2& b) const {
        const glm::uvec3& t = scene.triangles[triangle];
        const glm::vec2 uv =
            scene.uvs[t.x] * (1 - b.x - b.y) + scene.uvs[t.y] * b.x + scene.uvs[t.z] * b.y;
        const TexelQuad q = texel_quad(records[0], transform_uv(records[0], uv));
        const auto of = [&](std::uint32_t index) {
            const auto c = std::bit_cast<glm::u8vec4>(scene.images[0]->texels[index]);
            return glm::vec4(linear(c.r), linear(c.g), linear(c.b), 1);
        };
        return interpolate(q, of(q.t00), of(q.t10), of(q.t01), of(q.t11));
    }

    /// As kernels/emission.h: the density at the point that two numbers choose, and its numbers.
    double choose(std::uint32_t triangle, glm::vec2& u) const {
        TexelNumbers n = begin_texels(u);
        std::uint32_t at = mean_of(trees, triangle).root;
        while (words[at] != 0) {
            const bool upper =
                descend_by_share(words[at] & 1u, std::bit_cast<float>(words[at + 1]), n);
            at = (words[at] >> 1u) + (upper ? words_of_texel_node : 0u);
        }
        u = end_texels(n);
        return double(n.density);
    }
    double density(std::uint32_t triangle, const glm::vec2& b) const {
        TexelNumbers n = begin_texels(numbers_of_point(b.x, b.y));
        std::uint32_t at = mean_of(trees, triangle).root;
        while (words[at] != 0) {
            const bool upper =
                descend_by_place(words[at] & 1u, std::bit_cast<float>(words[at + 1]), n);
            at = (words[at] >> 1u) + (upper ? words_of_texel_node : 0u);
        }
        return double(n.density);
    }
};

constexpr std::array<glm::vec2, 4> inside{
    glm::vec2(0.1f, 0.2f), {0.9f, 0.1f}, {0.2f, 0.8f}, {0.95f, 0.99f}};
constexpr std::array<glm::vec2, 4> beyond{glm::vec2(-2.3f, 0.2f), {1.4f, -1}, {0.2f, 3.7f}, {5, 5}};

TEST(TexelRange, HoldsEveryTexelThatIsRead) {
    std::mt19937 random(3);
    std::uniform_real_distribution<double> place(-3, 3), size(0, 1);
    for (const auto& [width, height] : {std::pair{1u, 1u}, {1u, 257u}, {7u, 5u}, {64u, 33u}}) {
        TextureImage image{.width = width, .height = height};
        image.texels = random_texels(width * height, 0.2, random);
        const TexelRange range(image);
        for (const Wrap wrap : {Wrap::repeat, Wrap::mirrored_repeat, Wrap::clamp_to_edge}) {
            for (int i = 0; i < 200; ++i) {
                const std::uint32_t flag = wrap == Wrap::repeat          ? texture_repeat
                                           : wrap == Wrap::clamp_to_edge ? texture_clamp
                                                                         : texture_mirror;
                TextureRecord t{};
                t.width = width;
                t.height = height;
                t.flags = flag | flag << texture_wrap_v | (i % 2 == 0 ? texture_nearest : 0u);
                const Texture texture{.wrap_u = wrap, .wrap_v = wrap, .nearest = i % 2 == 0};
                const glm::dvec2 from(place(random), place(random));
                const glm::dvec2 to = from + glm::dvec2(size(random), size(random)) * size(random);
                const glm::dvec2 scale(width, height);
                const auto found = range.within(from * scale, to * scale, texture);
                for (int k = 0; k < 20; ++k) {
                    const glm::vec2 at(glm::mix(from, to, glm::dvec2(size(random), size(random))));
                    const TexelQuad q = texel_quad(t, at);
                    for (const std::uint32_t index : {q.t00, q.t10, q.t01, q.t11}) {
                        const auto c = std::bit_cast<glm::u8vec4>(image.texels[index]);
                        ASSERT_EQ(glm::min(found.low, c), found.low) << width << ", " << i;
                        ASSERT_EQ(glm::max(found.high, c), found.high) << width << ", " << i;
                    }
                }
            }
        }
    }
}

TEST(TexelTrees, AreDensitiesThatSamplesFollow) {
    std::mt19937 random(5);
    std::uniform_real_distribution<float> unit;
    for (const bool nearest : {true, false}) {
        for (const auto& uvs : {inside, beyond}) {
            for (const Wrap wrap : {Wrap::repeat, Wrap::mirrored_repeat, Wrap::clamp_to_edge}) {
                const Lamp lamp(16, random_texels(16 * 12, 0.8, random), wrap, nearest, uvs);
                for (const std::uint32_t triangle : {1u, 2u}) {
                    const TexelMean mean = mean_of(lamp.trees, triangle);
                    EXPECT_GE(mean.root, srgb_codes);
                    glm::dvec3 sum(0), plain(0);
                    double densities = 0;
                    double most = 0;
                    constexpr int samples = 20'000;
                    for (int i = 0; i < samples; ++i) {
                        glm::vec2 u((float(i) + 0.5f) / samples, unit(random));
                        const glm::vec2 even = sample_triangle(u);
                        plain += lamp.color(triangle, even);
                        densities += lamp.density(triangle, even);
                        const double density = lamp.choose(triangle, u);
                        const glm::vec2 b = sample_triangle(u);
                        ASSERT_GT(density, 0);
                        const glm::dvec3 sample = lamp.color(triangle, b) / density;
                        sum += sample;
                        most = std::max(most, sample.g);
                        if (lamp.color(triangle, even).g > 0) {
                            ASSERT_GT(lamp.density(triangle, even), 0);
                        }
                    }
                    EXPECT_NEAR(densities / samples, 1, 0.1);
                    for (int channel = 0; channel < 3; ++channel) {
                        EXPECT_NEAR(sum[channel] / plain[channel], 1, 0.06);
                        EXPECT_NEAR((channel == 0   ? mean.r
                                     : channel == 1 ? mean.g
                                                    : mean.b) *
                                        samples / sum[channel],
                                    1, 0.03);
                    }
                    // No sample is a firefly.
                    EXPECT_LT(most, 24 * double(mean.g));
                }
            }
        }
    }
}

TEST(TexelTrees, ChooseWhereTheyKnowTheDensity) {
    std::mt19937 random(6);
    std::uniform_real_distribution<float> unit;
    const Lamp lamp(8, random_texels(64, 0.5, random), Wrap::repeat, true, inside);
    int differ = 0;
    for (int i = 0; i < 5000; ++i) {
        glm::vec2 u(unit(random), unit(random));
        const double density = lamp.choose(1, u);
        differ += lamp.density(1, sample_triangle(u)) == density ? 0 : 1;
    }
    EXPECT_LT(differ, 5); // at the borders of cells, by rounding
}

TEST(TexelTrees, OfOneColourAreLeaves) {
    const Lamp lamp(2, std::vector<std::uint32_t>(4, texel(188, 255, 0)), Wrap::repeat, false,
                    inside);
    EXPECT_EQ(lamp.words.size(), srgb_codes + words_of_texel_node);
    for (const std::uint32_t triangle : {1u, 2u}) {
        const TexelMean mean = mean_of(lamp.trees, triangle);
        EXPECT_NEAR(mean.r, linear(188), 1e-6);
        EXPECT_NEAR(mean.g, 1, 1e-6);
        EXPECT_EQ(mean.b, 0);
    }
    EXPECT_EQ(mean_of(lamp.trees, 0).root, 0u);
    EXPECT_EQ(mean_of(lamp.trees, 0).r, 1);
}

TEST(TexelTrees, OfBlackTexelsHaveNoPower) {
    const Lamp lamp(1, {texel(0, 0, 0)}, Wrap::repeat, false, beyond);
    EXPECT_EQ(mean_of(lamp.trees, 1).r + mean_of(lamp.trees, 1).g + mean_of(lamp.trees, 1).b, 0);
}

TEST(TexelTrees, StayWithinTheirMemory) {
    std::mt19937 random(9);
    const Lamp lamp(1024, random_texels(1024 * 1024, 0.9, random), Wrap::repeat, true, inside);
    EXPECT_LE(lamp.words.size(), srgb_codes + most_texel_tree_words);
    EXPECT_GT(lamp.words.size(), most_texel_tree_words / 2);
}

} // namespace
} // namespace argand::testing
