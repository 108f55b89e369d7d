#include "ywcyp10_tables.hpp"

#include "bench.hpp"
#include "imagespace/cube_centers.hpp"
#include "world/world.hpp"

namespace argand {

namespace {

constexpr std::uint32_t details[] = {2, 4, 8, 16, 24};
constexpr std::uint32_t centers = 8;
constexpr std::uint32_t size = 128;

} // namespace

PaperTable bench_cube_making(Device& device) {
    PaperTable table{"Making cube maps"};
    for (const std::uint32_t detail : details) {
        const Scene scene = make_room_of_spheres(detail);
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
