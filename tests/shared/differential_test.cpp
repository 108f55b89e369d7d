// Differentials in double precision against central differences of photons that are really traced.
#define ARGAND_REAL_DOUBLE
#include "differential_case.hpp"
#include "differential_oracle.hpp"

#include <algorithm>
#include <gtest/gtest.h>
#include <vector>

namespace argand::truth {

PathEnd path_end(int start, unsigned seed, unsigned walls) {
    const oracle::paths::Path p = trace(oracle::paths::Start(start), seed, walls, oracle::vec2(0));
    return {p.differential.dp_du, p.differential.dp_dv, p.conditioning};
}

} // namespace argand::truth

namespace argand::oracle {
namespace {

using paths::Start;

/// Distance of both differentials from central differences, relative to the longer one.
double finite_difference_error(Start start, uint seed, uint walls, bool& alike, double& conditioning) {
    const double h = 1e-4;
    const paths::Path center = trace(start, seed, walls, vec2(0));
    conditioning = center.conditioning;
    alike = true;
    double error = 0;
    for (int k = 0; k < 2; ++k) {
        const vec2 step = k == 0 ? vec2(h, 0) : vec2(0, h);
        const paths::Path forth = trace(start, seed, walls, step);
        const paths::Path back = trace(start, seed, walls, -step);
        alike = alike && forth.alike && back.alike;
        const vec3 truth = (forth.neighbour - back.neighbour) / (2 * h);
        const vec3 ours = k == 0 ? center.differential.dp_du : center.differential.dp_dv;
        error = std::max(error, glm::length(ours - truth) / glm::length(truth));
    }
    return error;
}

TEST(Differential, AgreesWithNeighbouringPhotons) {
    for (int start = 0; start < paths::start_count; ++start) {
        for (uint walls = 0; walls <= 4; ++walls) {
            int compared = 0;
            for (uint seed = 0; seed < 500; ++seed) {
                bool alike;
                double conditioning;
                const double error = finite_difference_error(Start(start), seed, walls, alike, conditioning);
                if (alike && conditioning > 0.1) {
                    ++compared;
                    ASSERT_LT(error, 1e-4) << start << " " << walls << " " << seed << " " << conditioning;
                }
            }
            EXPECT_GT(compared, 150) << start << " " << walls;
        }
    }
}

} // namespace
} // namespace argand::oracle
