// Compares methods of adding the fluxes of ten million photons: their errors, their costs, and
// whether the engine's methods meet their bounds.
#include "results.hpp"
#include "shared/compensated.h"
#include "shared/fixed_point.h"
#include "shared/photon.h"

#include <chrono>
#include <cmath>
#include <functional>
#include <gtest/gtest.h>
#include <random>
#include <vector>

namespace argand::testing {
namespace {

/// Fluxes over twelve orders of magnitude, like those of lights of very different power after many
/// scatterings.
std::vector<float> any_fluxes(std::size_t count) {
    std::mt19937 bits(5);
    std::lognormal_distribution<float> flux(0.0f, 3.0f);
    std::vector<float> fluxes(count);
    for (float& f : fluxes) {
        f = std::min(flux(bits), 1e6f);
    }
    return fluxes;
}

float naive(const std::vector<float>& terms) {
    float sum = 0;
    for (const float x : terms) {
        sum += x;
    }
    return sum;
}

float halves(const float* terms, std::size_t count) {
    return count == 1 ? terms[0]
                      : halves(terms, count / 2) + halves(terms + count / 2, count - count / 2);
}

/// Sums 1024 chunks, like a device's invocations, and then their sums.
float chunks(const std::vector<float>& terms) {
    float sum = 0;
    const std::size_t size = (terms.size() + 1023) / 1024;
    for (std::size_t first = 0; first < terms.size(); first += size) {
        float part = 0;
        for (std::size_t i = first; i < std::min(first + size, terms.size()); ++i) {
            part += terms[i];
        }
        sum += part;
    }
    return sum;
}

/// The kernels' own addition.
float kahan(const std::vector<float>& terms) {
    float sum = 0;
    float lost = 0;
    for (const float x : terms) {
        add_compensated(sum, lost, x);
    }
    return sum;
}

float neumaier(const std::vector<float>& terms) {
    float sum = 0;
    float lost = 0;
    for (const float x : terms) {
        const float t = sum + x;
        lost += std::abs(sum) >= std::abs(x) ? (sum - t) + x : (x - t) + sum;
        sum = t;
    }
    return sum + lost;
}

/// Like photon ledgers and flux_sum.h: the unit is relative to the mean flux; 64 bits in two words.
double fixed_point(const std::vector<float>& terms, double mean, double unit_of_the_mean) {
    const auto unit = static_cast<float>(mean * unit_of_the_mean);
    glm::uvec2 sum(0);
    for (const float x : terms) {
        sum = fixed_add(sum, glm::uvec2(flux_units(x, unit), 0u));
    }
    return (double(sum.y) * 4294967296.0 + double(sum.x)) * double(unit);
}

double in_double(const std::vector<float>& terms) {
    double sum = 0;
    for (const float x : terms) {
        sum += double(x);
    }
    return sum;
}

/// Kahan's sum in extended or double precision, far more accurate than the others.
long double exact(const std::vector<float>& terms) {
    long double sum = 0;
    long double lost = 0;
    for (const float x : terms) {
        const long double y = static_cast<long double>(x) - lost;
        const long double t = sum + y;
        lost = (t - sum) - y;
        sum = t;
    }
    return sum;
}

struct Sum {
    const char* name;
    const char* used; ///< where the engine uses it
    bool any_order;   ///< gives the same bits for every order of the terms
    double bound;     ///< of the relative error; 0: no bound
    std::function<double(const std::vector<float>&)> add;
};

void check_sums(std::size_t count) {
    const std::vector<float> fluxes = any_fluxes(count);
    std::vector<float> reversed(fluxes.rbegin(), fluxes.rend());
    const auto truth = static_cast<double>(exact(fluxes));
    const double mean = truth / static_cast<double>(count);
    const Sum sums[] = {
        {"float, one after another", "", false, 0, [](const auto& x) { return double(naive(x)); }},
        {"float, 1,024 chunks", "", false, 0, [](const auto& x) { return double(chunks(x)); }},
        {"float, pairwise", "", false, 1e-6,
         [](const auto& x) { return double(halves(x.data(), x.size())); }},
        {"compensated (Kahan), ordered", "density estimates, film", false, 2e-7,
         [](const auto& x) { return double(kahan(x)); }},
        {"compensated (Neumaier), ordered", "", false, 0,
         [](const auto& x) { return double(neumaier(x)); }},
        {"fixed point, mean / 2^18, 64 bits", "flux of a pass", true, 1e-7,
         [mean](const auto& x) { return fixed_point(x, mean, 0x1p-18); }},
        {"double", "", false, 1e-12, [](const auto& x) { return in_double(x); }},
    };
    for (const Sum& sum : sums) {
        SCOPED_TRACE(sum.name);
        double best = HUGE_VAL;
        double value = 0;
        for (int i = 0; i < 3; ++i) {
            const auto start = std::chrono::steady_clock::now();
            value = sum.add(fluxes);
            best = std::min(
                best,
                std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
        }
        const double error = std::abs(value - truth) / truth;
        const double other_way = sum.add(reversed);
        if (sum.bound > 0) {
            EXPECT_LE(error, sum.bound);
        }
        if (sum.any_order) {
            EXPECT_EQ(other_way, value);
        }
        record_result("sums", {{"name", sum.name},
                               {"used", sum.used},
                               {"terms", count},
                               {"error", error},
                               {"reversed", std::abs(other_way - value) / truth},
                               {"bound", sum.bound},
                               {"ns", 1e9 * best / static_cast<double>(count)}});
    }
    // The reason for the other methods.
    EXPECT_GT(std::abs(double(naive(fluxes)) - truth) / truth, 1e-6);
}

TEST(Sums, OfTenMillionPhotons) { check_sums(10'000'000); }

} // namespace
} // namespace argand::testing
