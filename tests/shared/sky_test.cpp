#include "sky_case.hpp"

#include "base/error.hpp"

namespace argand {
namespace {

// Even a sun of 10^5 in a sky of 10^-3 leaves every cell a range of its own.
TEST(SkyTable, EveryCellThatIsNotBlackIsFound) {
    Sky sky(table_of(2048, 1024, one_bright(2048, 1024, 3, 300, 1e-3f, 1e5f)));
    SkyKernel& k = sky.kernel;
    for (uint row = 0; row <= 1024; ++row) {
        ASSERT_GE(k.sky[k.row_of_sky(row + 1)] - k.sky[k.row_of_sky(row)], 16u) << row;
        for (uint column = 0; column < 2048; ++column) {
            // 2^-24, so that random numbers of 24 bits find it.
            ASSERT_GE(k.digits_of_cell(row, column), 128u) << row << ", " << column;
        }
    }
}

TEST(SkyTable, TexelsKeepEighteenBitsOfTheLargestChannel) {
    std::mt19937 bits(9);
    std::uniform_real_distribution<double> exponent(-25, 30), share(0, 1);
    for (int i = 0; i < 100'000; ++i) {
        const double largest = std::pow(10.0, exponent(bits));
        const glm::vec3 radiance(largest, largest * share(bits), largest * share(bits) * 1e-3);
        const vec3 found = sky_radiance(packed_radiance(radiance));
        for (int c = 0; c < 3; ++c) {
            ASSERT_NEAR(found[c], radiance[c], double(radiance.r) * 0x1p-18) << i << ", " << c;
        }
    }
    EXPECT_EQ(sky_radiance(packed_radiance(glm::vec3(0))), vec3(0));
    for (const float exact : {1.0f, 0.5f, 0x1.fffffp0f, 1e30f}) {
        EXPECT_NEAR(sky_radiance(packed_radiance(glm::vec3(exact))).y, exact, exact * 0x1p-18);
    }
    EXPECT_EQ(sky_radiance(packed_radiance({1, 0.5f, 0.25f})), vec3(1, 0.5f, 0.25f));
}

// A picture that a device cannot hold is halved until it fits, and sends the same light.
TEST(SkyTable, PicturesThatDoNotFitAreReduced) {
    for (const glm::ivec2& size : {glm::ivec2(64, 32), glm::ivec2(37, 19), glm::ivec2(500, 1)}) {
        Environment environment;
        environment.picture =
            make_sky_picture(size.x, size.y, noise(size.x, size.y, 0.1, 10), "test");
        const std::uint64_t whole = words_of_sky(size.x, size.y);
        EXPECT_EQ(make_sky_table(environment, whole).halvings, 0u);
        const SkyTable half = make_sky_table(environment, whole - 1);
        EXPECT_EQ(half.halvings, 1u);
        EXPECT_EQ(half.width, size.x / 2);
        EXPECT_EQ(half.words.size(), words_of_sky(half.width, half.height));
        EXPECT_EQ(make_sky_table(environment, 1).words.size(), words_of_sky(1, 1));
        const std::shared_ptr<const SkyPicture> less =
            reduced(*environment.picture, half.width, half.height);
        const double mean = environment.picture->mean.g;
        EXPECT_NEAR(less->mean.g, mean, 0.02 * mean) << size.x << " x " << size.y;
    }
    const SkyPicture even{.width = 9, .height = 5, .texels = Texels(45, glm::vec3(3))};
    const std::shared_ptr<const SkyPicture> less = reduced(even, 4, 2);
    for (const glm::vec3& texel : less->texels) {
        EXPECT_NEAR(texel.r, 3, 1e-6);
    }
}

TEST(SkyTable, PicturesThatAreNotSkiesAreErrors) {
    EXPECT_THROW(make_sky_picture(0, 0, {}, "none"), Error);
    EXPECT_THROW(make_sky_picture(2, 2, Texels(3, glm::vec3(1)), "few"), Error);
    EXPECT_THROW(make_sky_picture(1, 1, {glm::vec3(-1)}, "negative"), Error);
    EXPECT_THROW(make_sky_picture(1, 1, {glm::vec3(1, NAN, 1)}, "NaN"), Error);
    EXPECT_THROW(make_sky_picture(1, 1, {glm::vec3(INFINITY)}, "infinite"), Error);
    EXPECT_THROW(make_sky_picture(1, 1, {glm::vec3(2e30f)}, "bright"), Error);
}

TEST(SkyTable, NumbersOfADirectionAreItsOwn) {
    for (const Case& c : cases()) {
        Sky sky(c.table);
        const double of_sun = sky.kernel.sky_float(sun_probability);
        for (uint i = 0; i < 2000; ++i) {
            const vec4 u = random4(14, i, 0, 0);
            const vec3 d = sky.kernel.sample_sky(vec2(u.x, u.y));
            const glm::dvec2 found = numbers_of_direction(sky.table, d);
            ASSERT_TRUE(found.x >= 0 && found.x <= 1 && found.y >= 0 && found.y <= 1);
            if (u.x < of_sun) {
                continue; // the azimuth in a small disc is not known well
            }
            // Their direction again: the angle is less than a texel is wide.
            const vec3 again = sky.kernel.sample_sky(vec2(glm::min(found, 0.99999994)));
            ASSERT_LT(glm::distance(again, d), 0.2 / sky.table.height + 1e-3)
                << c.name << ", " << i;
        }
    }
}

} // namespace
} // namespace argand
