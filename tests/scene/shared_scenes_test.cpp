#include "gltf_builder.hpp"
#include "scene/summary.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <set>

// Loads the collection of scenes that may exist beside the repository (../shared/scenes). The other
// tests of this directory cover the same features; these files add breadth.

namespace argand {
namespace {

using testing_gltf::json;
namespace fs = std::filesystem;

struct SharedScenes : ::testing::Test {
    fs::path root = fs::path(ARGAND_SOURCE_DIR).parent_path() / "shared" / "scenes";
    void SetUp() override {
        if (!fs::exists(root)) {
            GTEST_SKIP() << "../shared/scenes does not exist; the other tests of this directory "
                            "cover the same features";
        }
    }
    std::vector<fs::path> files(const char* under) const {
        std::set<fs::path> found;
        for (const fs::directory_entry& entry : fs::recursive_directory_iterator(root / under)) {
            const std::string extension = entry.path().extension().string();
            if (extension == ".glb" || extension == ".gltf") {
                found.insert(entry.path());
            }
        }
        return {found.begin(), found.end()};
    }
};

void expect_sound(const Scene& scene, const std::string& file) {
    EXPECT_EQ(scene.normals.size(), scene.positions.size()) << file;
    EXPECT_EQ(scene.triangle_material.size(), scene.triangles.size()) << file;
    EXPECT_FALSE(scene.cameras.empty()) << file;
    for (const glm::vec3& normal : scene.normals) {
        const float length = glm::length(normal);
        ASSERT_TRUE(length == 0 || std::abs(length - 1) < 1e-6f) << file;
    }
    for (std::size_t i = 0; i < scene.triangles.size(); ++i) {
        for (int corner = 0; corner < 3; ++corner) {
            ASSERT_LT(scene.triangles[i][corner], scene.positions.size()) << file;
        }
        ASSERT_LT(scene.triangle_material[i], scene.materials.size()) << file;
    }
    const double area = surface_area(scene);
    EXPECT_TRUE(area > 0 && std::isfinite(area)) << file;
    EXPECT_FALSE(summary_text(scene).empty()) << file;
}

TEST_F(SharedScenes, ValidScenesLoad) {
    for (const char* folder : {"cornell", "papers", "rooms", "khronos"}) {
        for (const fs::path& file : files(folder)) {
            try {
                expect_sound(load_gltf(file), file.string());
            } catch (const Error& error) {
                const std::string problem = error.what();
                EXPECT_NE(problem.find("requires the extension"), std::string::npos) << problem;
            }
        }
    }
}

TEST_F(SharedScenes, MalformedScenesLoadOrExplainWhyNot) {
    for (const fs::path& file : files("malformed")) {
        std::string problem;
        try {
            expect_sound(load_gltf(file), file.string());
        } catch (const Error& error) {
            problem = error.what();
            EXPECT_EQ(problem.find('\n'), std::string::npos) << problem;
            EXPECT_NE(problem.find(file.filename().string()), std::string::npos) << problem;
        }
        std::ifstream report(file.string() + ".report.json");
        if (!problem.empty() && report && json::parse(report)["issues"]["numErrors"] == 0) {
            // Valid, but without a triangle, without data, or with unsupported features.
            const bool sensible =
                problem.find("nothing to render") != std::string::npos ||
                problem.find("requires the extension") != std::string::npos ||
                problem.find("has no uri") != std::string::npos ||
                problem.find("do not rise: key 1 is at 0") != std::string::npos ||
                problem.find("joint weights that sum to 0") != std::string::npos ||
                problem.find("Unsupported `type`") != std::string::npos;
            EXPECT_TRUE(sensible) << problem;
        }
    }
}

} // namespace
} // namespace argand
