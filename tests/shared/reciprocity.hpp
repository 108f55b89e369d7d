#pragma once

#include "materials.hpp"
#include "shared/query_bsdf.h"

#include <gtest/gtest.h>

namespace argand::testing {

/// Expects that materials scatter as much from b to a as from a to b, as much after they went
/// through a query's record, and what they scatter in double precision. any: draws a material.
template <typename AnyMaterial>
void expect_reciprocal_and_stable(unsigned seed, const AnyMaterial& any) {
    std::mt19937 bits(seed);
    for (int i = 0; i < 50'000; ++i) {
        const MaterialRecord m = any(bits);
        const vec3 a = any_upper(bits), b = any_upper(bits);
        const vec3 f = bsdf_eval(m, a, b, LOBES_ALL), g = bsdf_eval(m, b, a, LOBES_ALL);
        const ReflectionParameters queried =
            reflection_parameters(query_bsdf(reflection_parameters(m), 0, 0));
        ASSERT_EQ(bsdf_eval(queried, a, b, LOBES_ALL), f);
        const glm::dvec3 truth = truth::bsdf_eval(record_bytes(m), a, b, LOBES_ALL);
        const double alpha = std::max(double(ggx_alpha(m)), 1e-3);
        for (int k = 0; k < 3; ++k) {
            const double size = double(max_component(f));
            ASSERT_NEAR(f[k], g[k], 1e-5 * size) << "case " << i;
            ASSERT_NEAR(f[k], truth[k], (2e-3 + 1e-6 / alpha) * size + 1e-7) << "case " << i;
        }
    }
}

} // namespace argand::testing
