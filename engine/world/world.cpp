#include "world/world.hpp"

#include "scene/material_record.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <memory>
#include <span>
#include <utility>

namespace argand {

namespace {

// A tree is rebuilt once it costs so many times as much as when it was built.
constexpr double most_growth = 1.3;

std::vector<glm::vec4> padded(std::span<const glm::vec3> vectors) {
    std::vector<glm::vec4> result;
    result.reserve(vectors.size());
    for (const glm::vec3& v : vectors) {
        result.emplace_back(v, 0.0f);
    }
    return result;
}

/// Of each triangle the vertices and the material.
std::vector<glm::uvec4> triangle_records(const Scene& scene, std::size_t first, std::size_t count) {
    std::vector<glm::uvec4> triangles;
    triangles.reserve(count);
    for (std::size_t i = first; i < first + count; ++i) {
        triangles.emplace_back(scene.triangles[i], scene.triangle_material[i]);
    }
    return triangles;
}

std::vector<MaterialRecord> material_records(const Scene& scene) {
    std::vector<MaterialRecord> materials;
    materials.reserve(scene.materials.size());
    for (const Material& material : scene.materials) {
        materials.push_back(material_record(material));
    }
    return materials;
}

/// The vectors of a moving mesh among those of all vertices.
std::span<const glm::vec3> part_of(const std::vector<glm::vec3>& vectors, const MovingMesh& mesh) {
    return std::span(vectors).subspan(mesh.first_vertex, mesh.positions.size());
}

bool is_same(std::span<const glm::vec3> a, const std::vector<glm::vec3>& b) {
    return std::equal(a.begin(), a.end(), b.begin(), b.end());
}

/// Whether records have the same bits.
bool is_same(const MaterialRecord& a, const MaterialRecord& b) {
    using Words = std::array<std::uint32_t, sizeof(MaterialRecord) / sizeof(std::uint32_t)>;
    return std::bit_cast<Words>(a) == std::bit_cast<Words>(b);
}

/// Uploads elements from index `first` on.
template <class T>
std::uint64_t upload_part(Device& device, const Buffer& to, std::size_t first,
                          const std::vector<T>& elements) {
    const auto bytes = std::as_bytes(std::span(elements));
    device.upload(to, first * sizeof(T), bytes);
    return bytes.size();
}

} // namespace

World::World(Device& device, const Scene& scene) : device_(device) {
    const StageScope stage(device, "upload scene");
    positions_ = upload(device, "positions", padded(scene.positions));
    triangles_ = upload(device, "triangles", triangle_records(scene, 0, scene.triangles.size()));
    uploaded_materials_ = material_records(scene);
    materials_ = upload(device, "materials", uploaded_materials_);
    for (const MovingMesh& mesh : scene.motion.meshes) {
        const auto positions = part_of(scene.positions, mesh),
                   normals = part_of(scene.normals, mesh);
        uploaded_.push_back({{positions.begin(), positions.end()},
                             {normals.begin(), normals.end()},
                             mesh.mirrored});
    }
    build_tree(scene);
}

void World::build_tree(const Scene& scene) {
    bvh_ = TriangleBvh(); // frees the old one's memory before the new one takes its own
    bvh_ = build_triangle_bvh(device_, positions_, triangles_,
                              static_cast<std::uint32_t>(scene.triangles.size()),
                              !scene.motion.meshes.empty());
    cost_of_build_ = 0; // known when it is asked for
}

/// Uploads a mesh if it has moved. Returns whether the tree is affected.
bool World::upload_moved(const Scene& scene, std::size_t mesh, WorldUpdate& update) {
    const MovingMesh& moving = scene.motion.meshes[mesh];
    Uploaded& last = uploaded_[mesh];
    const auto positions = part_of(scene.positions, moving),
               normals = part_of(scene.normals, moving);
    const bool moved = !is_same(positions, last.positions),
               turned = moving.mirrored != last.mirrored;
    if (moved) {
        update.uploaded_bytes +=
            upload_part(device_, positions_, moving.first_vertex, padded(positions));
        last.positions.assign(positions.begin(), positions.end());
    }
    if (!is_same(normals, last.normals)) {
        if (normals_) {
            update.uploaded_bytes +=
                upload_part(device_, normals_, moving.first_vertex, padded(normals));
        }
        last.normals.assign(normals.begin(), normals.end());
    }
    if (turned) {
        update.uploaded_bytes +=
            upload_part(device_, triangles_, moving.first_triangle,
                        triangle_records(scene, moving.first_triangle, moving.triangles));
        last.mirrored = moving.mirrored;
    }
    update.moved_meshes += moved || turned ? 1 : 0;
    return moved || turned;
}

void World::upload_changed_materials(const Scene& scene, WorldUpdate& update) {
    const std::vector<MaterialRecord> records = material_records(scene);
    for (std::size_t i = 0; i < records.size(); ++i) {
        if (is_same(records[i], uploaded_materials_[i])) {
            continue;
        }
        uploaded_materials_[i] = records[i];
        update.uploaded_bytes += upload_part(device_, materials_, i, std::vector{records[i]});
        ++update.changed_materials;
    }
}

WorldUpdate World::update(const Scene& scene) {
    const StageScope stage(device_, "update scene");
    WorldUpdate update;
    upload_changed_materials(scene, update);
    for (std::size_t i = 0; i < scene.motion.meshes.size(); ++i) {
        update.refitted = upload_moved(scene, i, update) || update.refitted;
    }
    if (update.uploaded_bytes > 0) {
        areas_.reset();
        ++revision_;
    }
    if (!update.refitted) {
        return update;
    }
    if (!(cost_of_build_ > 0)) {
        cost_of_build_ = traversal_cost(device_, bvh_);
    }
    refit_triangle_bvh(device_, bvh_, positions_, triangles_);
    if (traversal_cost(device_, bvh_) > most_growth * cost_of_build_) {
        build_tree(scene);
        update.refitted = false;
        update.rebuilt = true;
    }
    return update;
}

void World::add_areas(const Scene& scene, DeviceScene& on_device) {
    if (!on_device.plan.needs(Feature::photon_map)) {
        on_device.areas.sums = unneeded(device_);
        return;
    }
    const float follow_roughness = on_device.plan.request.follow_roughness;
    if (!areas_ || areas_->follow_roughness != follow_roughness) {
        auto by_triangle =
            std::make_shared<const std::vector<double>>(areas_for_photons(scene, follow_roughness));
        SampledAreas sampled = sample_areas(device_, scene, *by_triangle, {});
        areas_ = {follow_roughness, std::move(by_triangle), std::move(sampled)};
    }
    on_device.photon_areas = areas_->by_triangle;
    on_device.areas = areas_->sampled;
    on_device.surface_area = areas_->sampled.area;
}

DeviceScene World::on_device(const Scene& scene, const Plan& plan) {
    const StageScope stage(device_, "upload scene");
    if (plan.needs(Feature::smooth_normals) && !normals_) {
        normals_ = upload(device_, "normals", padded(scene.normals));
    }
    DeviceScene result = prepare_scene(device_, scene, plan);
    result.positions = positions_;
    result.normals = plan.needs(Feature::smooth_normals) ? normals_ : unneeded(device_);
    result.triangles = triangles_;
    result.materials = materials_;
    result.bvh = bvh_;
    add_areas(scene, result);
    return result;
}

} // namespace argand
