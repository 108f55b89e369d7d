// Textures of glTF files: images in every place, samplers, coordinates, and what is wrong with
// them.
#include "base/base64.hpp"
#include "gltf_builder.hpp"
#include "scene/decode_image.hpp"
#include "shared/texture_record.h"

#include <bit>
#include <cmath>
#include <limits>

#define STB_IMAGE_WRITE_STATIC
#define STB_IMAGE_WRITE_IMPLEMENTATION
#define STBI_WRITE_NO_STDIO
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wunused-function"
#include <stb_image_write.h>
#pragma GCC diagnostic pop

namespace argand::testing_gltf {
namespace {

void append(void* context, void* data, int size) {
    auto& bytes = *static_cast<Bytes*>(context);
    const auto* begin = static_cast<const std::uint8_t*>(data);
    bytes.insert(bytes.end(), begin, begin + size);
}

/// A PNG of so many channels a pixel.
Bytes png(int width, int height, int channels, const Bytes& samples) {
    Bytes bytes;
    stbi_write_png_to_func(&append, &bytes, width, height, channels, samples.data(), 0);
    return bytes;
}

Bytes two_by_one() { return png(2, 1, 4, {10, 20, 30, 40, 250, 240, 230, 220}); }

Bytes jpeg() {
    const Bytes samples(std::size_t{3} * 16 * 8, 200);
    Bytes bytes;
    stbi_write_jpg_to_func(&append, &bytes, 16, 8, 3, samples.data(), 95);
    return bytes;
}

std::string as_data_uri(const Bytes& bytes, const std::string& type) {
    return "data:" + type + ";base64," + base64(bytes);
}

/// A triangle with texture coordinates whose material has a base colour texture.
struct TexturedFile {
    GltfBuilder builder;
    json attributes;

    explicit TexturedFile(json image, json sampler = nullptr, json info = {{"index", 0}}) {
        builder.root["images"] = json::array({std::move(image)});
        builder.root["textures"] = {{{"source", 0}}};
        if (!sampler.is_null()) {
            builder.root["samplers"] = json::array({std::move(sampler)});
            builder.root["textures"][0]["sampler"] = 0;
        }
        builder.root["materials"] = {{{"pbrMetallicRoughness", {{"baseColorTexture", info}}}}};
        attributes = {{"POSITION", builder.add_vectors(right_triangle())}};
    }
    TexturedFile& with_coordinates(const std::string& name, const std::vector<glm::vec2>& uvs) {
        attributes[name] =
            builder.add_accessor(builder.add_view(uvs), float_type, "VEC2", uvs.size());
        return *this;
    }
    TexturedFile& with_coordinates() {
        return with_coordinates("TEXCOORD_0", {{0, 0.25f}, {0.5f, 0.75f}, {-1, 2}});
    }
    GltfBuilder& finished() {
        builder.add_node(
            {{"mesh", builder.add_mesh({{"attributes", attributes}, {"material", 0}})}});
        return builder;
    }
};

json embedded(const Bytes& bytes, const std::string& type = "image/png") {
    return {{"uri", as_data_uri(bytes, type)}};
}

TEST(GltfTexture, ReadsTexelsAndCoordinates) {
    const Scene scene = TexturedFile(embedded(two_by_one())).with_coordinates().finished().load();
    ASSERT_EQ(scene.images.size(), 1u);
    const TextureImage& image = *scene.images[0];
    EXPECT_EQ(image.width, 2u);
    EXPECT_EQ(image.height, 1u);
    ASSERT_EQ(image.texels.size(), 2u);
    EXPECT_EQ(std::bit_cast<glm::u8vec4>(image.texels[0]), glm::u8vec4(10, 20, 30, 40));
    EXPECT_EQ(std::bit_cast<glm::u8vec4>(image.texels[1]), glm::u8vec4(250, 240, 230, 220));
    EXPECT_EQ(image.low, glm::u8vec4(10, 20, 30, 40));
    EXPECT_EQ(image.high, glm::u8vec4(250, 240, 230, 220));
    EXPECT_EQ(scene.uv_sets, 1u);
    EXPECT_EQ(scene.uvs, (std::vector<glm::vec2>{{0, 0.25f}, {0.5f, 0.75f}, {-1, 2}}));
    ASSERT_EQ(scene.textures.size(), 1u);
    EXPECT_TRUE(scene.textures[0].srgb);
    EXPECT_FALSE(scene.textures[0].nearest);
    EXPECT_EQ(scene.textures[0].wrap_u, Wrap::repeat);
    EXPECT_EQ(scene.materials[0].texture_bits, material_base_color_texture);
    EXPECT_FALSE(scene.materials[0].alpha_varies); // its alphaMode is OPAQUE
}

TEST(GltfTexture, ReadsImagesFromFilesAndBuffers) {
    const TempDirectory directory;
    directory.write("images/a b.png", two_by_one());
    const GltfBuilder file =
        TexturedFile(json{{"uri", "images/a%20b.png"}}).with_coordinates().finished();
    EXPECT_EQ(load_gltf(directory.write("scene.glb", file.glb())).images[0]->width, 2u);

    TexturedFile in_buffer(json{{"mimeType", "image/jpeg"}});
    in_buffer.builder.root["images"][0]["bufferView"] = in_buffer.builder.add_view(jpeg());
    const Scene scene = in_buffer.with_coordinates().finished().load();
    EXPECT_EQ(scene.images[0]->width, 16u);
    EXPECT_NEAR(scene.images[0]->low.r, 200, 2);
    EXPECT_EQ(scene.images[0]->low.a, 255);
}

TEST(GltfTexture, ReadsGreyAndSixteenBits) {
    const Scene grey =
        TexturedFile(embedded(png(1, 1, 1, {77}))).with_coordinates().finished().load();
    EXPECT_EQ(std::bit_cast<glm::u8vec4>(grey.images[0]->texels[0]), glm::u8vec4(77, 77, 77, 255));
    const Scene with_alpha =
        TexturedFile(embedded(png(1, 1, 2, {77, 5}))).with_coordinates().finished().load();
    EXPECT_EQ(std::bit_cast<glm::u8vec4>(with_alpha.images[0]->texels[0]),
              glm::u8vec4(77, 77, 77, 5));
}

TEST(GltfTexture, ReadsSamplers) {
    const json sampler{{"wrapS", 33071}, {"wrapT", 33648}, {"magFilter", 9728}};
    const Scene scene =
        TexturedFile(embedded(two_by_one()), sampler).with_coordinates().finished().load();
    EXPECT_EQ(scene.textures[0].wrap_u, Wrap::clamp_to_edge);
    EXPECT_EQ(scene.textures[0].wrap_v, Wrap::mirrored_repeat);
    EXPECT_TRUE(scene.textures[0].nearest);
}

TEST(GltfTexture, ReadsTransformsAndTheirCoordinates) {
    const json info{
        {"index", 0},
        {"texCoord", 0},
        {"extensions",
         {{"KHR_texture_transform",
           {{"offset", {3, 4}}, {"rotation", 0.5}, {"scale", {2, 5}}, {"texCoord", 1}}}}}};
    const Scene scene = TexturedFile(embedded(two_by_one()), nullptr, info)
                            .with_coordinates("TEXCOORD_1", {{1, 0}, {0, 1}, {0, 0}})
                            .finished()
                            .load();
    EXPECT_EQ(scene.textures[0].uv_set, 1u);
    EXPECT_EQ(scene.uv_sets, 2u);
    EXPECT_EQ(scene.uvs[1], glm::vec2(1, 0));
    // Scaled, then turned counter-clockwise as seen with v downwards, then moved.
    const glm::vec2 of_u = scene.textures[0].transform * glm::vec3(scene.uvs[1], 1);
    EXPECT_NEAR(of_u.x, 3 + 2 * std::cos(0.5), 1e-6);
    EXPECT_NEAR(of_u.y, 4 - 2 * std::sin(0.5), 1e-6);
    const glm::vec2 of_v = scene.textures[0].transform * glm::vec3(scene.uvs[3], 1);
    EXPECT_NEAR(of_v.x, 3 + 5 * std::sin(0.5), 1e-6);
    EXPECT_NEAR(of_v.y, 4 + 5 * std::cos(0.5), 1e-6);
}

TEST(GltfTexture, SharesImagesBetweenMaterials) {
    TexturedFile file(embedded(two_by_one()));
    file.builder.root["materials"].push_back(
        {{"pbrMetallicRoughness", {{"metallicRoughnessTexture", {{"index", 0}}}}}});
    const Scene scene = file.with_coordinates().finished().load();
    EXPECT_EQ(scene.images.size(), 1u);
    ASSERT_EQ(scene.textures.size(), 2u);
    EXPECT_FALSE(scene.textures[1].srgb);
    EXPECT_EQ(scene.materials[1].texture_bits, material_metal_texture);
    EXPECT_EQ(scene.materials[1].first_texture, 1u);
}

TEST(GltfTexture, AlphaVariesUnlessItIsOpaque) {
    for (const auto& [mode, varies] :
         {std::pair{"OPAQUE", false}, {"MASK", true}, {"BLEND", true}}) {
        TexturedFile file(embedded(two_by_one()));
        file.builder.root["materials"][0]["alphaMode"] = mode;
        EXPECT_EQ(file.with_coordinates().finished().load().materials[0].alpha_varies, varies)
            << mode;
    }
    TexturedFile opaque(embedded(jpeg(), "image/jpeg"));
    opaque.builder.root["materials"][0]["alphaMode"] = "MASK";
    EXPECT_FALSE(opaque.with_coordinates().finished().load().materials[0].alpha_varies);
}

TEST(GltfTexture, ReadsColoursOfVertices) {
    GltfBuilder builder = one_triangle(); // without colours: white
    const std::vector<std::uint8_t> colors{0, 51, 255, 255, 255, 255, 0, 255, 102, 0, 0, 0};
    const int accessor = builder.add_accessor(builder.add_view(colors), ubyte_type, "VEC4", 3);
    builder.root["accessors"][std::size_t(accessor)]["normalized"] = true;
    builder.add_node(
        {{"mesh", builder.add_mesh({{"attributes",
                                     {{"POSITION", builder.add_vectors(right_triangle())},
                                      {"COLOR_0", accessor}}}})}});
    const Scene scene = builder.load();
    ASSERT_EQ(scene.colors.size(), 6u);
    EXPECT_EQ(scene.colors[2], glm::u16vec4(65535));
    EXPECT_EQ(scene.colors[3], glm::u16vec4(0, 13107, 65535, 65535));
    EXPECT_EQ(scene.colors[5], glm::u16vec4(26214, 0, 0, 0));
}

std::string problem_of(TexturedFile file) { return file.finished().problem(); }

void expect_problem(TexturedFile file, const std::string& part) {
    const std::string problem = problem_of(std::move(file));
    EXPECT_NE(problem.find(part), std::string::npos) << problem;
    EXPECT_EQ(problem.find('\n'), std::string::npos) << problem;
}

TEST(GltfTexture, TellsWhatIsWrongWithAnImage) {
    const auto image = [](json object) {
        return TexturedFile(std::move(object)).with_coordinates();
    };
    expect_problem(image({{"uri", "missing.png"}}), "missing.png");
    expect_problem(image({{"uri", "https://example.org/a.png"}}), "neither a file nor base64");
    expect_problem(image(json::object()), "Neither required `bufferView` nor `uri`");
    expect_problem(image({{"bufferView", 77}}), "bufferView \"77\" not found");
    expect_problem(image(embedded({1, 2, 3, 4, 5, 6, 7, 8})), "neither PNG nor JPEG");
    Bytes cut_png = two_by_one();
    cut_png.resize(cut_png.size() - 20);
    expect_problem(image(embedded(cut_png)), "damaged");
    Bytes cut_jpeg = jpeg();
    cut_jpeg.resize(cut_jpeg.size() - 2);
    expect_problem(image(embedded(cut_jpeg, "image/jpeg")), "cut short");
    Bytes huge = two_by_one(); // claims 50,000 x 50,000 pixels
    for (const std::size_t at : {16, 20}) {
        huge[at] = 0;
        huge[at + 1] = 0;
        huge[at + 2] = 0xc3;
        huge[at + 3] = 0x50;
    }
    expect_problem(image(embedded(huge)), "more than 64 million");
}

TEST(GltfTexture, RefusesColoursForPrint) {
    Bytes cmyk = jpeg();
    for (std::size_t i = 2; i + 9 < cmyk.size(); ++i) {
        if (cmyk[i] == 0xff && cmyk[i + 1] == 0xc0) {
            cmyk[i + 9] = 4;
        }
    }
    expect_problem(TexturedFile(embedded(cmyk, "image/jpeg")).with_coordinates(), "CMYK");
}

TEST(GltfTexture, PutsGreyInThePlaceOfAMissingImage) {
    const TempDirectory directory;
    TexturedFile file(json{{"uri", "missing.png"}});
    file.builder.root["materials"][0]["normalTexture"] = {{"index", 1}};
    file.builder.root["images"].push_back({{"uri", "missing too.png"}});
    file.builder.root["textures"].push_back({{"source", 1}});
    const auto path = directory.write("scene.glb", file.with_coordinates().finished().glb());
    try {
        load_gltf(path);
        FAIL();
    } catch (const Error& problem) {
        EXPECT_NE(std::string(problem.what()).find("--missing-textures grey"), std::string::npos)
            << problem.what();
    }
    const Scene scene = load_gltf(path, {}, {.grey_for_missing = true});
    EXPECT_EQ(std::bit_cast<glm::u8vec4>(scene.images[0]->texels[0]),
              glm::u8vec4(188, 188, 188, 255));
    EXPECT_EQ(std::bit_cast<glm::u8vec4>(scene.images[1]->texels[0]),
              glm::u8vec4(128, 128, 255, 255));
    EXPECT_TRUE(has_note(scene, "2 images do not exist: grey is in their place"));
    // Only missing files are replaced.
    directory.write("missing.png", Bytes{1, 2, 3});
    EXPECT_THROW(load_gltf(path, {}, {.grey_for_missing = true}), Error);
}

TEST(GltfTexture, ReadsEveryTextureOfAMaterialInTheOrderOfItsUses) {
    TexturedFile file(embedded(two_by_one()));
    const json info{{"index", 0}};
    json& material = file.builder.root["materials"][0];
    material["pbrMetallicRoughness"]["metallicRoughnessTexture"] = info;
    material["emissiveTexture"] = info;
    material["emissiveFactor"] = {1, 1, 1};
    material["normalTexture"] = {{"index", 0}, {"scale", 0.5}};
    material["occlusionTexture"] = info;
    material["extensions"] = {
        {"KHR_materials_specular", {{"specularTexture", info}, {"specularColorTexture", info}}},
        {"KHR_materials_transmission", {{"transmissionFactor", 1}, {"transmissionTexture", info}}},
        {"KHR_materials_volume", {{"thicknessFactor", 1}, {"thicknessTexture", info}}}};
    const Scene scene = TexturedFile(file).with_coordinates().finished().load();
    const Material& of = scene.materials[0];
    ASSERT_EQ(of.texture_count, 8u);
    for (std::uint32_t i = 0; i < of.texture_count; ++i) {
        EXPECT_EQ(scene.textures[of.first_texture + i].use, TextureUse(i)) << i;
    }
    EXPECT_EQ(scene.textures[3].scale, 0.5f);
    EXPECT_TRUE(scene.textures[2].srgb && scene.textures[5].srgb);
    EXPECT_FALSE(scene.textures[3].srgb || scene.textures[4].srgb || scene.textures[6].srgb);
    EXPECT_EQ(scene.tangents.size(), 1u);
    for (const std::string& note : scene.notes) {
        EXPECT_EQ(note.find("Texture"), std::string::npos) << note;
    }
    material["emissiveFactor"] = {0, 0, 0}; // shines nowhere
    material["extensions"]["KHR_materials_transmission"]["transmissionFactor"] = 0;
    EXPECT_EQ(TexturedFile(file).with_coordinates().finished().load().materials[0].texture_count,
              5u);
    material["occlusionTexture"] = {{"index", 7}}; // is not used, but must be valid
    expect_problem(file.with_coordinates(), "occlusionTexture is texture 7, which does not exist");
}

// A coat keeps its normals where a texture turns those of the surface.
TEST(GltfTexture, CoatsHaveNormalsOfTheirOwn) {
    TexturedFile file(embedded(two_by_one()));
    json& material = file.builder.root["materials"][0];
    json& coat = material["extensions"]["KHR_materials_clearcoat"];
    const auto load = [&] { return TexturedFile(file).with_coordinates().finished().load(); };
    coat = {{"clearcoatFactor", 1}};
    EXPECT_FALSE(load().materials[0].coat_has_normal);
    material["normalTexture"] = {{"index", 0}};
    EXPECT_TRUE(load().materials[0].coat_has_normal);
    material.erase("normalTexture");
    coat["clearcoatNormalTexture"] = {{"index", 0}, {"scale", 0.5}};
    const Scene scene = load();
    EXPECT_TRUE(scene.materials[0].coat_has_normal);
    EXPECT_EQ(scene.textures.back().use, TextureUse::coat_normal);
    EXPECT_EQ(scene.textures.back().scale, 0.5f);
    EXPECT_FALSE(scene.textures.back().srgb);
    EXPECT_EQ(scene.tangents.size(), 1u);
    coat["clearcoatNormalTexture"]["scale"] = 0;
    EXPECT_FALSE(load().materials[0].coat_has_normal);
    coat["clearcoatNormalTexture"]["scale"] = 1;
    coat["clearcoatFactor"] = 0;
    EXPECT_FALSE(load().materials[0].coat_has_normal);
    coat["clearcoatNormalTexture"]["index"] = 7;
    expect_problem(file.with_coordinates(), "clearcoatNormalTexture is texture 7");
}

// Tangents of a surface that is anisotropic but has no textures follow the first coordinates.
TEST(GltfTexture, AnisotropyNeedsCoordinatesOrTangents) {
    TexturedFile file(embedded(two_by_one()));
    file.builder.root["materials"][0] = {
        {"extensions", {{"KHR_materials_anisotropy", {{"anisotropyStrength", 1}}}}}};
    const Scene bare = TexturedFile(file).finished().load();
    EXPECT_TRUE(has_note(bare, "is anisotropic but has neither tangents nor texture coordinates"));
    EXPECT_EQ(bare.tangents.size(), 1u);
    const std::vector<glm::vec2> uvs{{0, 1}, {0, 0}, {1, 1}};
    const Scene scene = TexturedFile(file).with_coordinates("TEXCOORD_0", uvs).finished().load();
    EXPECT_FALSE(has_note(scene, "is anisotropic"));
    EXPECT_EQ(scene.uvs, uvs);
    const std::vector<glm::vec2> turned{{0, 1}, {1, 1}, {0, 0}};
    EXPECT_NE(scene.tangents,
              TexturedFile(file).with_coordinates("TEXCOORD_0", turned).finished().load().tangents);
    file.builder.root["materials"][0]["extensions"]["KHR_materials_anisotropy"] = json::object();
    EXPECT_EQ(TexturedFile(file).with_coordinates("TEXCOORD_0", uvs).finished().load().uv_sets, 0u);
}

// A dial that glows lights no model; without a studio, all but the dial would be black.
TEST(GltfTexture, GlowByTexelsDoesNotReplaceAMissingLight) {
    for (const double strength : {1.0, 3.0}) {
        TexturedFile file(embedded(two_by_one()));
        json& material = file.builder.root["materials"][0];
        material["emissiveFactor"] = {1, 0.5, 0};
        material["extensions"] = {
            {"KHR_materials_emissive_strength", {{"emissiveStrength", strength}}}};
        EXPECT_FALSE(
            has_note(TexturedFile(file).with_coordinates().finished().load(), "there is no light"))
            << strength;
        material["emissiveTexture"] = {{"index", 0}};
        EXPECT_EQ(has_note(file.with_coordinates().finished().load(), "there is no light"),
                  strength == 1)
            << strength;
    }
}

TEST(GltfTexture, TellsWhatIsWrongWithATexture) {
    const auto info = [](json object) {
        return TexturedFile(embedded(two_by_one()), nullptr, std::move(object)).with_coordinates();
    };
    expect_problem(info({{"index", 5}}), "texture 5, which does not exist");
    expect_problem(info({{"index", 0}, {"texCoord", 3}}), "has no TEXCOORD_3");
    const auto transformed = [&](json transform) {
        return info({{"index", 0}, {"extensions", {{"KHR_texture_transform", transform}}}});
    };
    expect_problem(transformed({{"scale", {1}}}), "not two numbers");
    expect_problem(transformed(3), "is not an object");
    expect_problem(info(nullptr), "not an object with the index of a texture");
    expect_problem(info({{"texCoord", 0}}), "not an object with the index of a texture");
    expect_problem(transformed({{"offset", {1e300, 0}}}), "not finite");
    TexturedFile no_image = info({{"index", 0}});
    no_image.builder.root["textures"][0]["source"] = 9;
    expect_problem(no_image, "image 9, which does not exist");
    TexturedFile no_sampler = info({{"index", 0}});
    no_sampler.builder.root["textures"][0]["sampler"] = 9;
    expect_problem(no_sampler, "sampler that does not exist");
    expect_problem(TexturedFile(embedded(two_by_one()), {{"wrapS", 1}}).with_coordinates(),
                   "wrapS");
}

TEST(GltfTexture, TellsWhatIsWrongWithCoordinates) {
    expect_problem(TexturedFile(embedded(two_by_one())), "has no TEXCOORD_0");
    const float nan = std::numeric_limits<float>::quiet_NaN();
    expect_problem(TexturedFile(embedded(two_by_one()))
                       .with_coordinates("TEXCOORD_0", {{0, 0}, {nan, 0}, {0, 1}}),
                   "texture coordinates that are not finite");
    expect_problem(
        TexturedFile(embedded(two_by_one())).with_coordinates("TEXCOORD_0", {{0, 0}, {1, 0}}),
        "3 positions but 2 texture coordinates");
}

TEST(GltfTexture, IgnoresFormatsThatItDoesNotKnowWithANote) {
    TexturedFile file(embedded(two_by_one()));
    file.builder.root["textures"][0].erase("source");
    const Scene scene = file.with_coordinates().finished().load();
    EXPECT_TRUE(has_note(scene, "has no PNG or JPEG and is ignored"));
    EXPECT_EQ(scene.materials[0].texture_bits, 0u);
}

} // namespace
} // namespace argand::testing_gltf
