#include "bench.hpp"
#include "bench_scene.hpp"
#include "imagespace/cube_centers.hpp"
#include "world/world.hpp"
#include "ywcyp10.hpp"

namespace argand {

namespace {

constexpr std::uint32_t details[] = {2, 4, 8, 16, 24};
constexpr std::uint32_t centers = 8;
constexpr std::uint32_t size = 128;

/// The bench scene with a lamp, all of one material.
Scene make_scene(std::uint32_t detail) {
    const BenchScene shape = make_bench_scene(detail);
    Scene scene;
    scene.name = "bench";
    for (const glm::vec4& position : shape.positions) {
        scene.positions.emplace_back(position);
        scene.normals.emplace_back(0);
    }
    for (const glm::uvec4& triangle : shape.triangles) {
        scene.triangles.emplace_back(triangle);
        scene.triangle_material.push_back(0);
    }
    Material material;
    material.metallic = 0;
    material.specular = 0;
    scene.materials.push_back(material);
    scene.lights.push_back(Light{.kind = LightKind::point, .position = shape.light});
    scene.cameras.emplace_back();
    return scene;
}

} // namespace

PaperTable bench_cube_making(Device& device) {
    PaperTable table{"Making cube maps"};
    for (const std::uint32_t detail : details) {
        const Scene scene = make_scene(detail);
        World world(device, scene);
        const DeviceScene on_device = world.on_device(scene, make_plan(scene, {}));
        const std::uint32_t triangles = on_device.record.triangle_count;
        const std::vector<glm::vec3> places = random_centers(on_device.box, centers, 1);
        const auto seconds = [&](const auto& work) {
            return median_host_seconds([&] { device.wait(); },
                                       [&] {
                                           work();
                                           device.wait();
                                       });
        };
        const auto making = [&](MapMaking how) {
            return seconds([&] { make_cube_maps(device, on_device, places, size, 1, how); });
        };
        nlohmann::ordered_json row{{"triangles", triangles},
                                   {"tree [s]", seconds([&] {
                                        build_triangle_bvh(device, on_device.positions,
                                                           on_device.triangles, triangles);
                                    })},
                                   {"cast [s]", making(MapMaking::cast)}};
        if (max_drawn_size(device) >= size) {
            row["draw [s]"] = making(MapMaking::raster);
        }
        table.rows.push_back(row);
    }
    return table;
}

} // namespace argand
