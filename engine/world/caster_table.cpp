#include "world/caster_table.hpp"

#include "kernels/caster_boxes.hpp"
#include "scene/texture_range.hpp"
#include "shared/caster_records.h"
#include "shared/follow.h"
#include "shared/geometry_records.h"
#include "world/connected_triangles.hpp"

#include <algorithm>
#include <map>

namespace argand {

namespace {

void extend(Bounds& box, const glm::vec3& low, const glm::vec3& high) {
    box.low = glm::min(box.low, low);
    box.high = glm::max(box.high, high);
}

/// Uploads the vertices of each moving caster, which may be listed several times, in parts.
/// Sorts the lists.
void upload_parts(Device& device, std::map<std::uint32_t, std::vector<std::uint32_t>>& casters,
                  CasterTable& table) {
    std::vector<std::uint32_t> vertices;
    std::vector<CasterPart> parts;
    for (auto& [root, own] : casters) {
        std::sort(own.begin(), own.end());
        own.erase(std::unique(own.begin(), own.end()), own.end());
        for (std::size_t i = 0; i < own.size(); i += most_vertices_of_caster_part) {
            const std::size_t count =
                std::min<std::size_t>(own.size() - i, most_vertices_of_caster_part);
            parts.push_back({static_cast<std::uint32_t>(vertices.size() + i),
                             static_cast<std::uint32_t>(count)});
            table.caster_of_part.push_back(table.moving);
        }
        vertices.insert(vertices.end(), own.begin(), own.end());
        ++table.moving;
    }
    table.vertices = upload(device, "vertices of casters", vertices);
    table.parts = upload(device, "parts of casters", parts);
}

/// The boxes of the casters that move.
std::vector<Bounds> moving_boxes(Device& device, const CasterTable& table,
                                 const Buffer& positions) {
    const std::size_t parts = table.caster_of_part.size();
    std::vector<Bounds> boxes(table.moving);
    if (parts == 0) {
        return boxes;
    }
    const Buffer part_boxes = device.allocate("boxes of casters", parts * sizeof(BoxRecord));
    dispatch(device,
             kernels::caster_boxes{.parts = table.parts,
                                   .vertices = table.vertices,
                                   .positions = positions,
                                   .boxes = part_boxes,
                                   .params = {static_cast<std::uint32_t>(parts)}},
             parts);
    const std::vector<BoxRecord> found = download<BoxRecord>(device, part_boxes, parts);
    for (std::size_t i = 0; i < parts; ++i) {
        const BoxRecord& box = found[i];
        extend(boxes[table.caster_of_part[i]], {box.low_x, box.low_y, box.low_z},
               {box.high_x, box.high_y, box.high_z});
    }
    return boxes;
}

glm::vec4 sphere_around(const Bounds& box) {
    const glm::vec3 center = 0.5f * (box.low + box.high);
    return {center, 1.001f * glm::distance(center, box.high)};
}

} // namespace

std::vector<bool> are_followed(const Scene& scene, float follow_roughness) {
    std::vector<bool> followed;
    followed.reserve(scene.materials.size());
    for (const Material& material : scene.materials) {
        const auto lobes = [&](const MaterialRecord& record) {
            return followed_lobes(record, follow_roughness);
        };
        followed.push_back(lobes_anywhere(scene, material, lobes) != 0);
    }
    return followed;
}

CasterTable make_caster_table(Device& device, const Scene& scene,
                              const std::vector<bool>& followed) {
    const std::vector<const MovingMesh*> mover = movers(scene);
    const std::vector<std::uint32_t> triangles = triangles_of(scene, followed);
    DisjointSets sets = connected(scene, triangles, mover);
    std::map<std::uint32_t, Bounds> at_rest;
    std::map<std::uint32_t, std::vector<std::uint32_t>> moving;
    for (std::uint32_t i = 0; i < triangles.size(); ++i) {
        const glm::uvec3& t = scene.triangles[triangles[i]];
        if (mover[triangles[i]] != nullptr) {
            std::vector<std::uint32_t>& vertices = moving[sets.root(i)];
            vertices.insert(vertices.end(), {t.x, t.y, t.z});
            continue;
        }
        Bounds& box = at_rest[sets.root(i)];
        for (int k = 0; k < 3; ++k) {
            extend(box, scene.positions[t[k]], scene.positions[t[k]]);
        }
    }
    CasterTable table;
    table.at_rest.reserve(at_rest.size());
    for (const auto& [root, box] : at_rest) {
        table.at_rest.push_back(box);
    }
    upload_parts(device, moving, table);
    return table;
}

std::vector<glm::vec4> caster_spheres(Device& device, const CasterTable& table,
                                      const Buffer& positions) {
    std::vector<Bounds> boxes = moving_boxes(device, table, positions);
    boxes.insert(boxes.end(), table.at_rest.begin(), table.at_rest.end());
    std::vector<glm::vec4> spheres;
    spheres.reserve(boxes.size());
    for (const Bounds& box : boxes) {
        spheres.push_back(sphere_around(box));
    }
    return spheres;
}

} // namespace argand
