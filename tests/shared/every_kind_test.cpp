// Every lobe of a BSDF and every kind of light has its part in all functions that must know it: a
// new one that is forgotten in some of them fails here (docs/adding.md).
#include "lights.hpp"
#include "materials.hpp"
#include "shared/follow.h"
#include "shared/light_differential.h"
#include "shared/query_bsdf.h"

#include <gtest/gtest.h>

namespace argand::testing {
namespace {

/// How many materials a function treats as having the lobe.
struct Found {
    int materials = 0, albedo = 0, probability = 0, samples = 0, value = 0, transported = 0;
};

Found find(uint lobe) {
    std::mt19937 bits(71);
    const vec3 wo = at_angle(30);
    Found found;
    for (int i = 0; i < 3000; ++i) {
        const MaterialRecord m = i % 3 == 0   ? any_phong(bits)
                                 : i % 3 == 1 ? any_coated(bits)
                                              : any_material(bits);
        if ((bsdf_lobes(m) & lobe) == 0u) {
            continue;
        }
        ++found.materials;
        found.albedo += max_component(bsdf_albedo(m, wo, true, lobe)) > 0 ? 1 : 0;
        const vec4 p = lobe_probabilities(m, wo, lobe);
        found.probability += p.x + p.y + p.z + p.w > 0 ? 1 : 0;
        BsdfSample s;
        const vec4 u(to_unit_float(bits), to_unit_float(bits), to_unit_float(bits), 0);
        const bool sampled = bsdf_sample(m, wo, true, lobe, u, s) && s.lobe == lobe;
        found.samples += sampled ? 1 : 0;
        float pdf = 0;
        const vec3 value = (lobe & LOBES_SPREAD) != 0u
                               ? spread_eval_and_pdf(m, wo, s.wi, true, lobe, lobe, pdf)
                               : bsdf_eval(m, wo, s.wi, lobe);
        found.value += sampled && max_component(value) > 0 ? 1 : 0;
        const uint followed = followed_lobes(m, 0.5f);
        found.transported += ((followed ^ estimated_lobes(m, 0.5f)) & lobe) != 0u ? 1 : 0;
    }
    return found;
}

TEST(EveryLobe, IsAmongTheRandomMaterialsAndInEveryFunction) {
    for (uint lobe = 1; lobe <= LOBES_ALL; lobe <<= 1) {
        SCOPED_TRACE(::testing::Message() << "lobe " << lobe);
        ASSERT_NE(LOBES_ALL & lobe, 0u);
        const Found found = find(lobe);
        // Lobes may be black in some material, and samples may be lost below the surface.
        EXPECT_GT(found.materials, 100);
        EXPECT_GT(found.albedo, found.materials / 2);
        EXPECT_GT(found.probability, found.materials / 2);
        EXPECT_GT(found.samples, found.materials / 4);
        EXPECT_EQ(found.value > found.materials / 4, (LOBES_DELTA & lobe) == 0u);
        EXPECT_EQ(found.transported, found.materials);
    }
}

// Kernels are specialised to the lobes and kinds of a scene: bits must not overlap.
TEST(EveryLobe, HasABitOfItsOwnInTheFeatures) {
    const uint features = MATERIAL_ALPHA | MATERIAL_GGX | MATERIAL_PHONG | MATERIAL_SOLID |
                          MATERIAL_ABSORPTION | MATERIAL_UNLIT | MATERIAL_COAT | MATERIAL_FILM |
                          MATERIAL_DISPERSION | MATERIAL_SHEEN | MATERIAL_ANISOTROPY |
                          MATERIAL_COAT_NORMAL | MATERIAL_NESTED;
    EXPECT_EQ(LOBES_ALL & features, 0u);
    EXPECT_EQ(LOBES_ALL | features, MATERIAL_ALL);
    EXPECT_EQ(LOBES_ALL & (LOBE_GLOSSY | MATERIAL_LAYER), LOBE_GLOSSY | LOBE_MIRROR);
}

// Queries of the photon map carry the parameters of a BSDF instead of a material's index.
TEST(EveryLobe, HasItsParametersInQueries) {
    std::mt19937 bits(72);
    for (int i = 0; i < 3000; ++i) {
        const MaterialRecord m = i % 3 == 0   ? any_phong(bits)
                                 : i % 3 == 1 ? any_coated(bits)
                                              : any_material(bits);
        const ReflectionParameters queried =
            reflection_parameters(query_bsdf(reflection_parameters(m), 0, 0));
        const vec3 wo = any_upper(bits), wi = any_upper(bits);
        ASSERT_EQ(bsdf_eval(queried, wo, wi, LOBES_ALL), bsdf_eval(m, wo, wi, LOBES_ALL));
    }
}

std::vector<LightRecord> one_of_each() {
    const vec3 color(3, 2, 1);
    return {point_light(vec3(0, 0, 2), color),
            spot_light(vec3(0, 0, 2), vec3(0, 0, -1), color, 30, 60),
            directional_light(vec3(0, 0, -1), color),
            triangle_light(vec3(-1, -1, 2), vec3(0, 1, 2), vec3(1, -1, 2), color, false),
            light(light_sky, color),
            light_from_picture(light(light_picture, color), vec3(0, 0, 1), color, 0.1f)};
}

TEST(EveryLight, IsInEveryFunction) {
    uint kinds = 0;
    for (const LightRecord& l : one_of_each()) {
        SCOPED_TRACE(::testing::Message() << "kind " << l.kind);
        const uint kind = 1u << l.kind;
        kinds |= kind;
        for (const uint known : {all_light_kinds, kind}) {
            EXPECT_GT(argand::light_power(l, known, 4.0f).y, 0);
            LightSample s;
            ASSERT_TRUE(argand::light_sample(l, known, vec3(0), vec2(0.3f, 0.6f), s));
            EXPECT_GT(s.radiance.y, 0);
            EXPECT_EQ(s.delta, s.pdf == 0);
            EmittedPhoton p;
            ASSERT_TRUE(argand::light_emit(l, known, {vec3(0), 4.0f}, vec4(0.3f, 0.6f, 0.2f, 0.7f),
                                           vec4(0.4f), p));
            EXPECT_EQ(p.flux, argand::light_power(l, known, 4.0f));
            const PhotonDifferential d = light_differential(l, known, p, 4.0f, 1000.0f, 1000.0f);
            EXPECT_GT(glm::length(d.dp_du) + glm::length(d.dd_du), 0);
            EXPECT_GT(glm::length(d.dp_dv) + glm::length(d.dd_dv), 0);
        }
    }
    EXPECT_EQ(kinds, all_light_kinds) << "the list above lacks a kind";
}

} // namespace
} // namespace argand::testing
