#include "gltf_builder.hpp"

#include <cstdint>
#include <gtest/gtest.h>

// Damaged files must either load or throw an Error of one line. The damage is deterministic, so
// that failures can be reproduced.

namespace argand {
namespace {

using namespace testing_gltf;

/// A file with one of each kind of object.
Bytes small_glb() {
    GltfBuilder builder;
    const int positions = builder.add_vectors({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}});
    const int normals = builder.add_vectors(std::vector<glm::vec3>(4, {0, 0, 1}));
    const int indices = builder.add_indices<std::uint8_t>({0, 1, 2, 0, 2, 3});
    const int sparse_indices = builder.add_view(std::vector<std::uint8_t>{1});
    const int sparse_values = builder.add_view(std::vector<glm::vec3>{{2, 0, 0}});
    builder.root["accessors"][0]["sparse"] = {
        {"count", 1},
        {"indices", {{"bufferView", sparse_indices}, {"componentType", ubyte_type}}},
        {"values", {{"bufferView", sparse_values}}}};
    builder.root["materials"] = {
        {{"emissiveFactor", {1, 0, 0}}, {"extensions", {{"KHR_materials_ior", {{"ior", 1.25}}}}}}};
    const int mesh =
        builder.add_mesh({{"attributes", {{"POSITION", positions}, {"NORMAL", normals}}},
                          {"indices", indices},
                          {"material", 0}});
    builder.root["cameras"] = {
        {{"type", "perspective"}, {"perspective", {{"yfov", 1}, {"znear", 1}}}}};
    builder.root["extensions"]["KHR_lights_punctual"]["lights"] = {
        {{"type", "spot"}, {"spot", json::object()}}};
    builder.add_node({{"mesh", mesh},
                      {"camera", 0},
                      {"rotation", {0, 0, 0, 1}},
                      {"extensions", {{"KHR_lights_punctual", {{"light", 0}}}}}});
    const int times =
        builder.add_accessor(builder.add_view(std::vector<float>{0, 1}), float_type, "SCALAR", 2);
    const json target{{"path", "pointer"},
                      {"extensions",
                       {{"KHR_animation_pointer",
                         {{"pointer", "/extensions/KHR_lights_punctual/lights/0/intensity"}}}}}};
    builder.root["animations"] = {{{"channels", {{{"sampler", 0}, {"target", target}}}},
                                   {"samplers", {{{"input", times}, {"output", times}}}}}};
    return builder.glb();
}

/// Whether the file loads. Fails the test if it throws anything but an Error of one line.
bool loads_or_explains(const TempDirectory& directory, const Bytes& bytes) {
    const auto file = directory.write("damaged.glb", bytes);
    try {
        load_gltf(file);
        return true;
    } catch (const Error& error) {
        EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos) << error.what();
        return false;
    }
}

TEST(GltfFuzz, TruncatedAtEveryLength) {
    const Bytes glb = small_glb();
    const TempDirectory directory;
    ASSERT_TRUE(loads_or_explains(directory, glb));
    for (std::size_t length = 0; length < glb.size(); ++length) {
        Bytes cut(glb.begin(), glb.begin() + std::ptrdiff_t(length));
        EXPECT_FALSE(loads_or_explains(directory, cut)) << "length " << length;
        if (length >= 12) { // with a header that states the same length
            cut[8] = static_cast<std::uint8_t>(length);
            cut[9] = static_cast<std::uint8_t>(length >> 8);
            EXPECT_FALSE(loads_or_explains(directory, cut)) << "length " << length;
        }
    }
}

TEST(GltfFuzz, EveryByteDamaged) {
    const Bytes glb = small_glb();
    const TempDirectory directory;
    int loaded = 0;
    for (std::size_t at = 0; at < glb.size(); ++at) {
        constexpr std::uint8_t flips[]{0x01, 0x80, 0xff};
        Bytes damaged = glb;
        damaged[at] ^= flips[at % 3];
        loaded += loads_or_explains(directory, damaged) ? 1 : 0;
    }
    EXPECT_GT(loaded, 0); // most bytes of the BIN chunk may have any value
}

TEST(GltfFuzz, DigitsAndBracketsReplaced) {
    // A changed digit leaves the JSON valid but makes offsets, counts, types and references
    // arbitrary.
    const Bytes glb = small_glb();
    const TempDirectory directory;
    int loaded = 0;
    for (std::size_t at = 20; at < glb.size(); ++at) {
        if (glb[at] < '0' || glb[at] > '9') {
            continue;
        }
        for (const char other : {'0', '9', '-', 'e'}) {
            Bytes damaged = glb;
            damaged[at] = static_cast<std::uint8_t>(other);
            loaded += loads_or_explains(directory, damaged) ? 1 : 0;
        }
    }
    EXPECT_GT(loaded, 0);
}

TEST(GltfFuzz, SeveralBytesDamagedAtRandomSlow) {
    const Bytes glb = small_glb();
    const TempDirectory directory;
    std::uint32_t state = 12345;
    const auto random =
        [&](std::uint32_t below) { // linear congruential generator of Numerical Recipes
            state = state * 1664525u + 1013904223u;
            return static_cast<std::uint32_t>((std::uint64_t(state) * below) >> 32);
        };
    for (int i = 0; i < 20000; ++i) {
        Bytes damaged = glb;
        const std::uint32_t count = 1 + random(8);
        for (std::uint32_t k = 0; k < count; ++k) {
            damaged[20 + random(static_cast<std::uint32_t>(damaged.size() - 20))] =
                random(2) ? static_cast<std::uint8_t>(random(256))
                          : glb[20 + random(static_cast<std::uint32_t>(glb.size() - 20))];
        }
        loads_or_explains(directory, damaged);
    }
}

} // namespace
} // namespace argand
