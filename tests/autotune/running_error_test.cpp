#include "autotune/running_error.hpp"
#include "image/mean.hpp"
#include "image/metrics.hpp"
#include "support/noisy_image.hpp"

#include <cmath>
#include <gtest/gtest.h>

namespace argand {
namespace {

using testing::noisy;

constexpr double exponent = 0.25;

/// The mean of passes whose noise rises, and whose bias falls, as those of progressive widths.
class ProgressivePasses {
public:
    ProgressivePasses(int width, int height, double bias, double deviation)
        : width_(width), height_(height), bias_(bias), deviation_(deviation) {}

    /// Adds a pass, and returns the mean so far.
    const Image& next() {
        ++count_;
        const double by = std::pow(count_, -exponent);
        const Image pass =
            noisy(width_, height_, bias_ * by, deviation_ / by, static_cast<std::uint32_t>(count_));
        mean_ = count_ > 1 ? weighted_mean(mean_, count_ - 1, pass, 1) : pass;
        return mean_;
    }

    double error() const {
        const Image truth = noisy(width_, height_, 0, 0, 0);
        return rel_mse(mean_, truth, truth);
    }

private:
    int width_, height_;
    double bias_, deviation_;
    Image mean_;
    double count_ = 0;
};

std::vector<Layer> layers_of(const Image& image) { return {{"", image}}; }

TEST(RunningError, IsThatOfThePicture) {
    struct Case {
        double bias, deviation;
        int width, height;
    };
    for (const Case& c : {Case{0.4, 0.05, 64, 64}, Case{0.2, 0.2, 64, 64}, Case{0.02, 0.4, 64, 64},
                          Case{0.2, 0.2, 300, 299}}) { // of the last one some pixels are read
        ProgressivePasses passes(c.width, c.height, c.bias, c.deviation);
        RunningError error(progressive_law(exponent), 0);
        std::uint64_t reads = 0;
        for (std::uint64_t pass = 1; pass <= 150; ++pass) {
            const Image& mean = passes.next();
            if (pass == error.next()) {
                error.add(layers_of(mean));
                ++reads;
            }
            ASSERT_GT(error.next(), pass);
            ASSERT_EQ(error.after(pass).has_value(), pass >= 32);
            if (pass >= 32) {
                EXPECT_LT(std::abs(std::log(*error.after(pass) / passes.error())), std::log(1.6))
                    << c.bias << ", " << c.deviation << ", " << pass;
            }
        }
        EXPECT_EQ(reads, 8u); // 8, 16, 24, 32, 48, 64, 96, 128
    }
}

TEST(RunningError, GoesOnWithAPictureThatWasBegunBefore) {
    ProgressivePasses passes(64, 64, 0.2, 0.2);
    RunningError error(progressive_law(exponent), 9);
    for (std::uint64_t pass = 1; pass <= 36; ++pass) {
        const Image& mean = passes.next();
        EXPECT_FALSE(error.after(pass));
        if (pass == error.next()) {
            error.add(layers_of(mean));
        }
    }
    ASSERT_TRUE(error.after(36));
    EXPECT_LT(std::abs(std::log(*error.after(36) / passes.error())), std::log(2.0));
}

TEST(RunningError, OfABlackOrATinyPictureIsANumber) {
    for (const Image& image :
         {Image{2, 2, std::vector<glm::vec3>(4, glm::vec3(0))}, Image{1, 1, {glm::vec3(1)}}}) {
        RunningError error(progressive_law(exponent), 0);
        for (int i = 0; i < 4; ++i) {
            error.add(layers_of(image));
        }
        ASSERT_TRUE(error.after(32));
        EXPECT_EQ(*error.after(32), 0);
    }
}

} // namespace
} // namespace argand
