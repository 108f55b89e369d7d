// The film's sums and numbers stay right over more samples than 32 bits count.
#include "device_fixture.hpp"
#include "kernels/film_add.hpp"
#include "methods/film.hpp"
#include "shared/path_records.h"

#include <cmath>
#include <limits>

namespace argand::testing {
namespace {

class FilmTest : public DeviceTest {
protected:
    Device& device() { return open(); }

    /// Adds these samples of the only pixel.
    void add(const Film& film, const std::vector<LayersRecord>& samples) {
        EyeBatch batch{};
        batch.pixels = 1;
        batch.samples = static_cast<std::uint32_t>(samples.size());
        batch.width = batch.height = 1;
        const std::vector<std::uint32_t> unfinished{0};
        dispatch(device(),
                 kernels::film_add{.layers = upload(device(), "layers", samples),
                                   .unfinished = upload(device(), "unfinished", unfinished),
                                   .film = film.parts[0],
                                   .batch = batch},
                 1);
    }

    RenderStatistics statistics_;
    glm::vec3 resolved(const Film& film) {
        return resolve_film(device(), film, statistics_)[1].image.pixels[0];
    }
};

LayersRecord direct_light(float radiance) {
    LayersRecord layers{};
    layers.direct_r = layers.direct_g = layers.direct_b = radiance;
    return layers;
}

TEST_F(FilmTest, SumsOfAMillionPassesAreThoseOfDoublePrecision) {
    constexpr int passes = 1'000'000, at_once = 10'000;
    const Film film = make_film(device(), 1, 1);
    double sum = 0;
    for (int first = 0; first < passes; first += at_once) {
        std::vector<LayersRecord> samples;
        samples.reserve(at_once);
        for (int i = first; i < first + at_once; ++i) {
            // Mostly dim, seldom very bright, as behind glass.
            const float radiance =
                0.1f + 0.37f * static_cast<float>(i % 7) + (i % 1009 == 0 ? 3e4f : 0.0f);
            samples.push_back(direct_light(radiance));
            sum += radiance;
        }
        add(film, samples);
    }
    EXPECT_NEAR(resolved(film).x, sum / passes, 1e-6 * sum / passes);
    EXPECT_EQ(statistics_.samples, std::uint64_t(passes));
}

TEST_F(FilmTest, NumbersOfSamplesGoOnBeyond32Bits) {
    const Film film = make_film(device(), 1, 1);
    constexpr std::uint32_t before = 0xffffffffu;
    FilmRecord record{};
    record.samples = before;
    record.non_finite = before - 3;
    record.direct_r = 9;
    device().upload(film.parts[0], 0, std::as_bytes(std::span(&record, 1)));
    std::vector<LayersRecord> samples(5, direct_light(std::numeric_limits<float>::quiet_NaN()));
    samples.push_back(direct_light(1));
    samples.push_back(direct_light(2));
    add(film, samples);
    EXPECT_FLOAT_EQ(resolved(film).x, (9 + 1 + 2) / 5.0f);
    EXPECT_EQ(statistics_.samples, std::uint64_t(before) + 7);
    EXPECT_EQ(statistics_.non_finite, std::uint64_t(before) + 2);
}

} // namespace
} // namespace argand::testing
