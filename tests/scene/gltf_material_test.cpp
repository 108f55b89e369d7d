#include "gltf_builder.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace argand {
namespace {

using namespace testing_gltf;

GltfBuilder with_material(const json& material) {
    GltfBuilder builder = one_triangle();
    builder.root["materials"] = nlohmann::json::array({material});
    builder.root["meshes"][0]["primitives"][0]["material"] = 0;
    return builder;
}

Material load_material(const json& material) {
    return with_material(material).load().materials.at(0);
}

json extension(const char* name, const json& value) { return {{"extensions", {{name, value}}}}; }

TEST(GltfMaterial, HasTheDefaultsOfGltf) {
    const Material material = load_material(json::object());
    EXPECT_EQ(material.base_color, glm::vec3(1));
    EXPECT_EQ(material.metallic, 1);
    EXPECT_EQ(material.roughness, 1);
    EXPECT_EQ(material.specular, 1);
    EXPECT_EQ(material.specular_color, glm::vec3(1));
    EXPECT_EQ(material.emission, glm::vec3(0));
    EXPECT_EQ(material.transmission, 0);
    EXPECT_EQ(material.ior, 1.5f);
    EXPECT_EQ(material.thickness, 0);
    EXPECT_EQ(material.coverage, 1);
    EXPECT_FALSE(material.double_sided);
}

TEST(GltfMaterial, ReadsTheCore) {
    const Material material = load_material({{"name", "paint"},
                                             {"doubleSided", true},
                                             {"pbrMetallicRoughness",
                                              {{"baseColorFactor", {0.25, 0.5, 0.75, 1}},
                                               {"metallicFactor", 0.125},
                                               {"roughnessFactor", 0}}}});
    EXPECT_EQ(material.name, "paint");
    EXPECT_TRUE(material.double_sided);
    EXPECT_EQ(material.base_color, glm::vec3(0.25, 0.5, 0.75));
    EXPECT_EQ(material.metallic, 0.125f);
    EXPECT_EQ(material.roughness, 0);
}

TEST(GltfMaterial, ReadsSpecular) {
    const Material material = load_material(extension(
        "KHR_materials_specular", {{"specularFactor", 0}, {"specularColorFactor", {2, 1, 0.5}}}));
    EXPECT_EQ(material.specular, 0);
    EXPECT_EQ(material.specular_color, glm::vec3(2, 1, 0.5)); // may exceed 1
}

TEST(GltfMaterial, MultipliesEmissionByItsStrength) {
    json material = extension("KHR_materials_emissive_strength",
                              {{"emissiveStrength", 10000000000}}); // > 32 bits
    material["emissiveFactor"] = {1, 0.5, 0};
    const Scene scene = with_material(material).load();
    EXPECT_EQ(scene.materials[0].emission, glm::vec3(1e10f, 5e9f, 0));
    EXPECT_FALSE(scene.environment);
    EXPECT_FALSE(has_note(scene, "no light"));
}

TEST(GltfMaterial, ReadsTransmissionVolumeAndIor) {
    const Material material =
        load_material({{"extensions",
                        {{"KHR_materials_transmission", {{"transmissionFactor", 0.75}}},
                         {"KHR_materials_volume", {{"thicknessFactor", 2}}},
                         {"KHR_materials_ior", {{"ior", 1.25}}}}}});
    EXPECT_EQ(material.transmission, 0.75f);
    EXPECT_EQ(material.thickness, 2);
    EXPECT_EQ(material.ior, 1.25f);
}

json with_alpha(double alpha, const char* mode) {
    return {{"pbrMetallicRoughness", {{"baseColorFactor", {1, 1, 1, alpha}}}}, {"alphaMode", mode}};
}

TEST(GltfMaterial, BlendsByAlphaAndScalesEmissionByIt) {
    json material = with_alpha(0.25, "BLEND");
    material["emissiveFactor"] = {1, 0.5, 0};
    const Material blended = load_material(material);
    EXPECT_EQ(blended.coverage, 0.25f);
    EXPECT_EQ(blended.emission, glm::vec3(0.25f, 0.125f, 0));
    material["alphaMode"] = "OPAQUE";
    EXPECT_EQ(load_material(material).coverage, 1);
    EXPECT_EQ(load_material(material).emission, glm::vec3(1, 0.5f, 0));
}

TEST(GltfMaterial, MaskedSurfacesArePresentOrAbsent) {
    EXPECT_EQ(load_material(with_alpha(0.5, "MASK")).coverage, 1); // the default cutoff is 0.5
    json material = with_alpha(0.75, "MASK");
    material["alphaCutoff"] = 0.75;
    EXPECT_EQ(load_material(material).coverage, 1);

    GltfBuilder builder = with_material(with_alpha(0.49, "MASK"));
    EXPECT_THAT(builder.problem(),
                ::testing::HasSubstr("no triangle that has an area and can be seen"));
    builder.add_triangles({{0, 0, 1}, {1, 0, 1}, {0, 1, 1}});
    const Scene scene = builder.load();
    EXPECT_EQ(scene.triangles.size(), 1u);
    EXPECT_TRUE(has_note(scene, "1 primitive is left out because alpha makes it invisible"));
}

TEST(GltfMaterial, BlendedSurfacesWithAlphaZeroAreAbsent) {
    json material = with_alpha(0, "BLEND");
    material["emissiveFactor"] = {1, 1, 1};
    GltfBuilder builder = with_material(material);
    builder.add_triangles({{0, 0, 1}, {1, 0, 1}, {0, 1, 1}});
    const Scene scene = builder.load();
    EXPECT_EQ(scene.triangles.size(), 1u);
    EXPECT_TRUE(scene.environment.has_value());
}

TEST(GltfMaterial, RejectsUnknownAlphaModesAndClampsAlpha) {
    using ::testing::HasSubstr;
    EXPECT_THAT(
        with_material(with_alpha(0.5, "blend")).problem(),
        HasSubstr("material 0 has the alphaMode \"blend\"; it must be OPAQUE, MASK or BLEND"));
    json cutoff = with_alpha(0.5, "MASK");
    cutoff["alphaCutoff"] = "half";
    EXPECT_THAT(with_material(cutoff).problem(),
                HasSubstr("\"alphaCutoff\" must be made of numbers"));
    cutoff["alphaCutoff"] = -1;
    EXPECT_TRUE(has_note(with_material(cutoff).load(),
                         "alphaCutoff of -1, which is out of range; 0 is used"));
    const Scene over = with_material(with_alpha(1.5, "BLEND")).load();
    EXPECT_EQ(over.materials[0].coverage, 1);
    EXPECT_TRUE(has_note(over, "alpha of 1.5, which is out of range; 1 is used"));
    EXPECT_FALSE(has_note(with_material(with_alpha(1.5, "OPAQUE")).load(), "alpha"));
}

json with_phong(const json& phong) {
    return {{"pbrMetallicRoughness", {{"baseColorFactor", {0.5, 0.25, 0, 1}}}},
            {"extras", {{"phong", phong}}}};
}

TEST(GltfMaterial, ReadsPhongFromExtras) {
    const Material material =
        load_material(with_phong({{"specular", {0.5, 0.25, 1}}, {"exponent", 40}}));
    ASSERT_TRUE(material.phong.has_value());
    EXPECT_EQ(material.base_color, glm::vec3(0.5f, 0.25f, 0));
    EXPECT_EQ(material.phong->specular, glm::vec3(0.5f, 0.25f, 1));
    EXPECT_EQ(material.phong->exponent, 40);
    EXPECT_TRUE(
        load_material(with_phong({{"specular", {0, 0, 0}}, {"exponent", 0}})).phong.has_value());
    EXPECT_FALSE(load_material({{"extras", {{"note", "phong"}}}}).phong.has_value());
    EXPECT_FALSE(load_material({{"extras", "phong"}}).phong.has_value());
}

TEST(GltfMaterial, RejectsInvalidPhong) {
    const auto problem = [](const json& specular, const json& exponent) {
        return with_material(with_phong({{"specular", specular}, {"exponent", exponent}}))
            .problem();
    };
    using ::testing::HasSubstr;
    const json good = {0.5, 0.25, 1};
    EXPECT_THAT(problem(good, -1),
                HasSubstr("material 0's \"phong\" has an exponent of -1; it must be at least 0"));
    EXPECT_THAT(problem(good, 1e300), HasSubstr("exponent of 1e+300"));
    EXPECT_THAT(problem(good, "sharp"), HasSubstr("\"exponent\" that is not a number"));
    EXPECT_THAT(problem(good, nullptr), HasSubstr("\"exponent\" that is not a number"));
    EXPECT_THAT(problem({0.5, 0.875, 1}, 1),
                HasSubstr("a specular colour of 0.875 beside a base colour of 0.25; it must"));
    EXPECT_THAT(problem({-0.5, 0, 0}, 1), HasSubstr("a specular colour of -0.5 beside"));
    EXPECT_THAT(problem({0.1, 0.1}, 1), HasSubstr("\"specular\" that is not three numbers"));
    EXPECT_THAT(problem(0.5, 1), HasSubstr("\"specular\" that is not three numbers"));
    for (const json& phong : {json(5), json::array({1, 2}), json("shiny"), json(nullptr),
                              json::object(), json{{"specular", good}}, json{{"exponent", 5}}}) {
        EXPECT_THAT(with_material(with_phong(phong)).problem(),
                    HasSubstr("is not an object with a \"specular\" and an \"exponent\""));
    }
}

TEST(GltfMaterial, RejectsIndicesOfRefractionBetweenZeroAndOne) {
    EXPECT_EQ(load_material(extension("KHR_materials_ior", {{"ior", 0}})).ior, 0);
    EXPECT_EQ(load_material(extension("KHR_materials_ior", {{"ior", 1}})).ior, 1);
    EXPECT_EQ(load_material(extension("KHR_materials_ior", {{"ior", 1 + 1e-7}})).ior, 1 + 0x1p-23f);
    EXPECT_EQ(load_material(extension("KHR_materials_ior", {{"ior", 10}})).ior, 10);
    for (const double ior : {0.5, -1.0, 0.999, 1e300}) {
        EXPECT_THAT(with_material(extension("KHR_materials_ior", {{"ior", ior}})).problem(),
                    ::testing::HasSubstr("index of refraction"));
    }
}

TEST(GltfMaterial, ClampsFactorsWithANote) {
    const Scene scene = with_material({{"name", "odd"},
                                       {"pbrMetallicRoughness",
                                        {{"baseColorFactor", {2, -1, 0.5, 1}},
                                         {"metallicFactor", -0.5},
                                         {"roughnessFactor", 7}}},
                                       {"emissiveFactor", {-1, 0, 0}}})
                            .load();
    const Material& material = scene.materials[0];
    EXPECT_EQ(material.base_color, glm::vec3(1, 0, 0.5));
    EXPECT_EQ(material.metallic, 0);
    EXPECT_EQ(material.roughness, 1);
    EXPECT_EQ(material.emission, glm::vec3(0));
    EXPECT_TRUE(has_note(
        scene, "material 0 \"odd\" has a baseColorFactor of 2, which is out of range; 1 is used"));
    EXPECT_TRUE(has_note(scene, "metallicFactor of -0.5"));
    EXPECT_TRUE(has_note(scene, "roughnessFactor of 7"));
    EXPECT_TRUE(has_note(scene, "emissiveFactor of -1"));
}

TEST(GltfMaterial, RejectsFactorsThatAreNotNumbers) {
    using ::testing::HasSubstr;
    EXPECT_THAT(with_material({{"pbrMetallicRoughness", {{"metallicFactor", "one"}}}}).problem(),
                HasSubstr("\"metallicFactor\" must be made of numbers"));
    EXPECT_THAT(
        with_material(extension("KHR_materials_volume", {{"thicknessFactor", json::array()}}))
            .problem(),
        HasSubstr("\"thicknessFactor\" that is not a number"));
    EXPECT_THAT(
        with_material(extension("KHR_materials_specular", {{"specularColorFactor", {1, 2}}}))
            .problem(),
        HasSubstr("\"specularColorFactor\" that is not three numbers"));
}

TEST(GltfMaterial, NotesAColourOfWrongLength) {
    const Scene scene =
        with_material({{"pbrMetallicRoughness", {{"baseColorFactor", {1, 0, 0}}}}}).load();
    EXPECT_TRUE(has_note(scene, "not quite valid glTF: Array length of `baseColorFactor`"));
}

TEST(GltfMaterial, CoatsFilmsSheenAndDispersion) {
    const json extensions{
        {"extensions",
         {{"KHR_materials_clearcoat",
           {{"clearcoatFactor", 0.5}, {"clearcoatRoughnessFactor", 0.25}}},
          {"KHR_materials_sheen",
           {{"sheenColorFactor", {0.25, 0.5, 1}}, {"sheenRoughnessFactor", 0.625}}},
          {"KHR_materials_dispersion", {{"dispersion", 0.5}}},
          {"KHR_materials_iridescence",
           {{"iridescenceFactor", 0.75},
            {"iridescenceIor", 1.25},
            {"iridescenceThicknessMaximum", 500}}}}}};
    const Material m = with_material(extensions).load().materials[0];
    EXPECT_EQ(m.coat, 0.5f);
    EXPECT_EQ(m.coat_roughness, 0.25f);
    EXPECT_EQ(m.dispersion, 0.5f);
    EXPECT_EQ(m.sheen_color, glm::vec3(0.25f, 0.5f, 1));
    EXPECT_EQ(m.sheen_roughness, 0.625f);
    EXPECT_EQ(m.film, 0.75f);
    EXPECT_EQ(m.film_ior, 1.25f);
    EXPECT_EQ(m.film_thickness, 0.5f);
    const Material plain = with_material(json::object()).load().materials[0];
    EXPECT_EQ(plain.coat, 0.0f);
    EXPECT_EQ(plain.film, 0.0f);
    EXPECT_EQ(plain.dispersion, 0.0f);
    EXPECT_TRUE(has_note(
        with_material(extension("KHR_materials_clearcoat", {{"clearcoatFactor", 2}})).load(),
        "clearcoatFactor of 2"));
    EXPECT_THAT(
        with_material(extension("KHR_materials_iridescence", {{"iridescenceIor", "x"}})).problem(),
        ::testing::HasSubstr("\"iridescenceIor\" that is not a number"));
}

TEST(GltfMaterial, AnisotropyIsStrengthAlongARotatedTangent) {
    const auto anisotropy = [](const json& members) {
        return with_material(extension("KHR_materials_anisotropy", members))
            .load()
            .materials[0]
            .anisotropy;
    };
    EXPECT_EQ(anisotropy(json::object()), glm::vec2(0));
    EXPECT_EQ(anisotropy({{"anisotropyStrength", 0.5}}), glm::vec2(0.5f, 0));
    const glm::vec2 turned =
        anisotropy({{"anisotropyStrength", 0.5}, {"anisotropyRotation", 2.0943951023931953}});
    EXPECT_NEAR(turned.x, -0.25, 1e-6);
    EXPECT_NEAR(turned.y, 0.4330127, 1e-6);
    EXPECT_TRUE(has_note(
        with_material(extension("KHR_materials_anisotropy", {{"anisotropyStrength", 2}})).load(),
        "anisotropyStrength of 2"));
    EXPECT_THAT(with_material(extension("KHR_materials_anisotropy", {{"anisotropyRotation", "x"}}))
                    .problem(),
                ::testing::HasSubstr("\"anisotropyRotation\" that is not a number"));
}

TEST(GltfMaterial, SolidsHaveAPriority) {
    const auto solid = [](const json& extras, double thickness = 1) {
        json material = extension("KHR_materials_volume", {{"thicknessFactor", thickness}});
        material["extras"] = extras;
        return with_material(material);
    };
    EXPECT_EQ(solid(json::object()).load().materials[0].priority, 0);
    EXPECT_EQ(solid({{"priority", -2.5}}).load().materials[0].priority, -2.5f);
    for (const json& other : {json("high"), json(nullptr), json(true), json({1}), json(1e300)}) {
        const Scene scene = solid({{"priority", other}}).load();
        EXPECT_EQ(scene.materials[0].priority, 0) << other;
        EXPECT_TRUE(has_note(scene, "\"priority\" that is not a number")) << other;
    }
    EXPECT_EQ(solid("no object").load().materials[0].priority, 0);
    EXPECT_FALSE(has_note(solid({{"priority", "high"}}, 0).load(), "priority")); // not a solid
}

TEST(GltfMaterial, VolumesAbsorb) {
    const auto absorption = [](const json& volume) {
        return with_material(extension("KHR_materials_volume", volume))
            .load()
            .materials[0]
            .absorption;
    };
    EXPECT_EQ(absorption({{"thicknessFactor", 1}}), glm::vec3(0));
    EXPECT_EQ(absorption({{"attenuationColor", {0.5, 0.2, 0.1}}}), glm::vec3(0));
    EXPECT_EQ(absorption({{"attenuationDistance", 3}}), glm::vec3(0));
    const glm::vec3 found =
        absorption({{"attenuationColor", {1, 0.5, 0}}, {"attenuationDistance", 0.25}});
    EXPECT_EQ(found.r, 0);
    EXPECT_FLOAT_EQ(found.g, float(4 * std::log(2.0)));
    EXPECT_EQ(found.b, std::numeric_limits<float>::max());
    for (const double distance : {0.0, -1.0}) {
        EXPECT_THAT(
            with_material(extension("KHR_materials_volume", {{"attenuationDistance", distance}}))
                .problem(),
            ::testing::HasSubstr("it must be above 0"));
    }
    EXPECT_TRUE(has_note(
        with_material(extension("KHR_materials_volume", {{"attenuationColor", {2, 0.5, 0}}}))
            .load(),
        "attenuationColor of 2"));
}

TEST(GltfMaterial, UnlitSurfacesShowTheirBaseColourOnly) {
    json material = extension("KHR_materials_unlit", json::object());
    material["pbrMetallicRoughness"] = {{"baseColorFactor", {0.1, 0.2, 0.3, 1}}};
    material["emissiveFactor"] = {1, 1, 1};
    const Scene scene = with_material(material).load();
    EXPECT_TRUE(scene.materials[0].unlit);
    EXPECT_EQ(scene.materials[0].base_color, glm::vec3(0.1f, 0.2f, 0.3f));
    EXPECT_EQ(scene.materials[0].emission, glm::vec3(0));
    EXPECT_FALSE(with_material(json::object()).load().materials[0].unlit);
}

TEST(GltfMaterial, TexturesThatDoNotExistAreErrors) {
    const json specular =
        extension("KHR_materials_specular", {{"specularTexture", {{"index", 0}}}});
    EXPECT_THAT(with_material(specular).problem(),
                ::testing::HasSubstr("specularTexture is texture 0, which does not exist"));
    const json emissive{{"emissiveFactor", {1, 1, 1}}, {"emissiveTexture", {{"index", 0}}}};
    EXPECT_THAT(with_material(emissive).problem(),
                ::testing::HasSubstr("emissiveTexture is texture 0, which does not exist"));
}

TEST(GltfExtensions, AreListedWithANoteIfNotSupported) {
    GltfBuilder builder = one_triangle();
    builder.root["extensionsUsed"] = {"KHR_materials_ior", "KHR_materials_diffuse_transmission",
                                      "KHR_materials_diffuse_transmission"};
    const Scene scene = builder.load();
    EXPECT_THAT(scene.extensions_used,
                ::testing::ElementsAre("KHR_materials_ior", "KHR_materials_diffuse_transmission"));
    EXPECT_TRUE(has_note(
        scene, "the extension KHR_materials_diffuse_transmission is not supported and is ignored"));
    EXPECT_FALSE(has_note(scene, "KHR_materials_ior"));
}

TEST(GltfExtensions, RejectsUnsupportedRequiredExtensions) {
    GltfBuilder builder = one_triangle();
    builder.root["extensionsUsed"] = {"KHR_materials_diffuse_transmission"};
    builder.root["extensionsRequired"] = {"KHR_materials_diffuse_transmission"};
    EXPECT_THAT(builder.problem(),
                ::testing::HasSubstr("requires the extension KHR_materials_diffuse_transmission"));
}

} // namespace
} // namespace argand
