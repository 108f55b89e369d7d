// Maps that the rasteriser draws against those that rays are cast for.
#include "imagespace/cube_centers.hpp"
#include "mapped_scene.hpp"
#include "shared/cube_map.h"
#include "shared/image_space_records.h"

#include <cmath>
#include <gtest/gtest.h>

namespace argand::testing {
namespace {

struct Difference {
    // Shares of all texels.
    double triangles = 0; ///< that show another triangle, or none
    double wrong = 0;     ///< that show the same triangle at another distance
    double empty = 0;     ///< that show nothing if drawn, and something if cast
};

class DrawnMaps : public MappedScene {
protected:
    void SetUp() override {
        DeviceTest::SetUp();
        if (max_drawn_size(open()) == 0) {
            GTEST_SKIP() << open().info().name << " has no rasteriser";
        }
    }

    std::vector<glm::uvec2> texels(const std::vector<glm::vec3>& centers, std::uint32_t size,
                                   MapMaking making) {
        const CubeMaps maps =
            make_cube_maps(open(), scene_, centers, size, layers_of(scene_), making);
        return download<glm::uvec2>(open(), maps.texels,
                                    centers.size() * cube_texels(size) * maps.layers);
    }

    /// Around 8 points in the scene's box.
    Difference difference(std::uint32_t size) {
        const std::vector<glm::vec3> centers = random_centers(scene_.box, 8, 1);
        const std::vector<glm::uvec2> cast = texels(centers, size, MapMaking::cast);
        const std::vector<glm::uvec2> drawn = texels(centers, size, MapMaking::raster);
        Difference found;
        for (std::size_t i = 0; i < cast.size(); ++i) {
            const float a = std::bit_cast<float>(cast[i].y);
            const float b = std::bit_cast<float>(drawn[i].y);
            // Behind surfaces that light passes, rays are cast from another place.
            const float error = layers_of(scene_) > 1 ? 1e-5f * a : 0;
            found.triangles += cast[i].x != drawn[i].x ? 1 : 0;
            found.wrong += cast[i].x == drawn[i].x && !(std::abs(a - b) <= error) ? 1 : 0;
            found.empty += cast[i].x != no_triangle && drawn[i].x == no_triangle ? 1 : 0;
        }
        const auto count = static_cast<double>(cast.size());
        return {found.triangles / count, found.wrong / count, found.empty / count};
    }
};

TEST_F(DrawnMaps, ShowWhatRaysHit) {
    for (const char* name : {"cornell_area.glb", "cornell_glass.glb", "closed_room.glb",
                             "forty_rooms.glb", "ring.glb", "textures.glb", "veil.glb"}) {
        load(name);
        const Difference found = difference(64);
        // Edges go through the middles of some texels.
        EXPECT_LT(found.triangles, 0.001) << name;
        EXPECT_LT(found.wrong, 0.0001) << name;
        EXPECT_LT(found.empty, 0.001) << name;
    }
}

TEST_F(DrawnMaps, ShowSurfacesAtAnyDistance) {
    // Floors that reach from 10 cm below and above the center to 1 km. Triangles that are 10^6
    // times as large as they are near lack texels on the edges of faces: clipping is not precise
    // enough.
    Scene scene = load_gltf(ARGAND_SOURCE_DIR "/assets/cornell_point.glb");
    scene.positions = {{-1000, 0, -1000},  {1000, 0, -1000},  {0, 0, 1000},
                       {-900, 0.2f, -900}, {900, 0.2f, -900}, {0, 0.2f, 900}};
    scene.normals.assign(6, glm::vec3(0));
    scene.triangles = {{0, 1, 2}, {3, 4, 5}};
    scene.triangle_material = {0, 0};
    scene_ = upload_scene(open(), scene, make_plan(scene, {}));
    // Seen from between both, and from above both.
    for (const float height : {0.1f, 0.3f}) {
        const std::vector<glm::vec3> centers{{1, height, 2}};
        const std::vector<glm::uvec2> cast = texels(centers, 64, MapMaking::cast);
        const std::vector<glm::uvec2> drawn = texels(centers, 64, MapMaking::raster);
        double different = 0;
        for (std::size_t i = 0; i < cast.size(); ++i) {
            different += cast[i] != drawn[i] ? 1 : 0;
        }
        EXPECT_LT(different, 0.001 * static_cast<double>(cast.size())) << height;
    }
}

TEST_F(DrawnMaps, MayHaveOneTexelAFaceAndManyCenters) {
    load("cornell_area.glb");
    const std::vector<glm::vec3> centers = random_centers(scene_.box, 30, 2);
    const std::vector<glm::uvec2> cast = texels(centers, 1, MapMaking::cast);
    const std::vector<glm::uvec2> drawn = texels(centers, 1, MapMaking::raster);
    int different = 0;
    for (std::size_t i = 0; i < cast.size(); ++i) {
        different += cast[i] != drawn[i] ? 1 : 0;
    }
    // The rasteriser rounds vertices to a part of a pixel, which here is a face.
    EXPECT_LE(different, 5);
    const std::vector<glm::uvec2> all = texels(centers, 8, MapMaking::raster);
    const std::vector<glm::uvec2> one = texels({centers[29]}, 8, MapMaking::raster);
    EXPECT_EQ(std::vector(all.end() - static_cast<std::ptrdiff_t>(one.size()), all.end()), one);
}

TEST_F(DrawnMaps, AreDrawnInPartsWhereTheDeviceHasFewLayers) {
    load("cornell_area.glb");
    const std::vector<glm::vec3> centers = random_centers(scene_.box, 5, 2);
    const std::vector<glm::uvec2> together = texels(centers, 16, MapMaking::raster);
    Device& device = open_anew({"few layers", "", "layers=13"});
    const Scene scene = load_gltf(ARGAND_SOURCE_DIR "/assets/cornell_area.glb");
    const DeviceScene on_device = upload_scene(device, scene, make_plan(scene, {}));
    const CubeMaps maps = make_cube_maps(device, on_device, centers, 16, 1, MapMaking::raster);
    EXPECT_EQ(download<glm::uvec2>(device, maps.texels, together.size()), together);
    EXPECT_EQ(max_drawn_size(open_anew({"fewer layers", "", "layers=5"})), 0u);
}

TEST_F(DrawnMaps, OfNothingShowNothing) {
    Scene scene = load_gltf(ARGAND_SOURCE_DIR "/assets/cornell_point.glb");
    scene.triangles.clear();
    scene.triangle_material.clear();
    scene_ = upload_scene(open(), scene, make_plan(scene, {}));
    for (const glm::uvec2& texel : texels({{0, 1, 0}}, 4, MapMaking::raster)) {
        EXPECT_EQ(texel, glm::uvec2(no_triangle, std::bit_cast<std::uint32_t>(far_away)));
    }
}

} // namespace
} // namespace argand::testing
