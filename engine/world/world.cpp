#include "world/world.hpp"

#include "base/same_bits.hpp"
#include "scene/texture_range.hpp"
#include "shared/bsdf.h"
#include "shared/solids.h"
#include "shared/texture_record.h"
#include "world/connected_triangles.hpp"

#include <algorithm>
#include <cstdint>
#include <span>
#include <utility>

namespace argand {

namespace {

// A tree is rebuilt once it costs so many times as much as when it was built
// (docs/results/frames.md: "When the tree is built anew").
constexpr double most_growth = 1.15;
// The device makes the lights of more emissive triangles than this, also of those that stand still,
// so that the host does not go through them in each frame. Of fewer the host knows each one: a
// photons queue tells as many lights apart (methods/queue_photons.cpp).
constexpr std::size_t most_lights_on_host = 256;

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

std::vector<MaterialRecord> material_records(const Scene& scene, const SolidRanks& solids) {
    std::vector<MaterialRecord> materials;
    materials.reserve(scene.materials.size());
    for (const Material& material : scene.materials) {
        materials.push_back(material_record(material));
        const bool varies =
            material.texture_bits != 0 || material.alpha_varies || !scene.colors.empty();
        const auto lobes = [](const MaterialRecord& record) { return bsdf_lobes(record); };
        if (varies &&
            (lobes_anywhere(scene, material, lobes) & (LOBE_DIFFUSE | LOBE_GLOSSY)) != 0) {
            materials.back().textures |= material_stores_everywhere;
        }
    }
    for (std::size_t i = 0; i < materials.size(); ++i) {
        materials[i].solids =
            solids.of_material[i] <= most_ranked_solids ? solids.of_material[i] : 0;
    }
    for (std::size_t rank = 0; rank < solids.materials.size(); ++rank) {
        materials[rank].solids |= solids.materials[rank] << solid_of_rank_shift;
    }
    return materials;
}

/// The bounding box of the triangles that do not move.
Bounds box_at_rest(const Scene& scene) {
    std::vector<bool> moves(scene.triangles.size(), false);
    for (const MovingMesh& mesh : scene.motion.meshes) {
        const auto first = moves.begin() + static_cast<std::ptrdiff_t>(mesh.first_triangle);
        std::fill(first, first + static_cast<std::ptrdiff_t>(mesh.triangles), true);
    }
    Bounds box;
    for (std::size_t i = 0; i < scene.triangles.size(); ++i) {
        for (int corner = 0; corner < 3 && !moves[i]; ++corner) {
            const glm::vec3& position = scene.positions[scene.triangles[i][corner]];
            box.low = glm::min(box.low, position);
            box.high = glm::max(box.high, position);
        }
    }
    return box;
}

AlphaSurfaces alpha_surfaces(const DeviceScene& scene) {
    return {.scene = scene.scene,
            .triangles = scene.triangles,
            .materials = scene.materials,
            .attributes = scene.attributes,
            .textures = scene.textures,
            .texels = scene.texels,
            .textured = scene.plan.needs(Feature::textures),
            .vertex_colors = scene.plan.needs(Feature::vertex_colors)};
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

World::World(Device& device, const Scene& scene, const TracerSettings& tracer)
    : device_(device), tracer_(tracer), surfaces_(surface_use(scene)), meshes_(device, scene),
      box_at_rest_(box_at_rest(scene)) {
    std::optional<StageScope> stage;
    stage.emplace(device, "upload scene");
    positions_ = upload(device, "positions", padded(scene.positions));
    triangles_ = upload(device, "triangles", triangle_records(scene, 0, scene.triangles.size()));
    uploaded_materials_ = material_records(scene, surfaces_.solids);
    materials_ = upload(device, "materials", uploaded_materials_);
    last_moved_.resize(scene.motion.meshes.size());
    mirrored_.reserve(scene.motion.meshes.size());
    for (const MovingMesh& mesh : scene.motion.meshes) {
        mirrored_.push_back(mesh.mirrored);
    }
    if (!meshes_.empty()) {
        meshes_.place(positions_, nullptr);
    }
    if (tracer.kdtree) {
        stage.reset(); // stages do not nest
        stage.emplace(device, "build kd-tree");
    }
    build_tree(scene);
}

void World::build_tree(const Scene& scene) {
    bvh_ = TriangleBvh(); // frees the old one's memory before the new one takes its own
    const auto count = static_cast<std::uint32_t>(scene.triangles.size());
    if (tracer_.kdtree) {
        bvh_ = build_triangle_kdtree(device_, positions_, triangles_, count,
                                     {.memory = tracer_.tree_memory});
        return;
    }
    bvh_ = build_triangle_bvh(device_, positions_, triangles_, count, !scene.motion.meshes.empty());
    cost_of_build_ = 0; // known when it is asked for
    tree_cost_ = 1;
}

void World::upload_turned(const Scene& scene, WorldUpdate& update) {
    for (std::size_t i = 0; i < mirrored_.size(); ++i) {
        const MovingMesh& mesh = scene.motion.meshes[i];
        if (mesh.mirrored != mirrored_[i]) {
            update.uploaded_bytes +=
                upload_part(device_, triangles_, mesh.first_triangle,
                            triangle_records(scene, mesh.first_triangle, mesh.triangles));
            mirrored_[i] = mesh.mirrored;
            last_moved_[i] = revision_ + 1;
            ++update.turned_meshes;
        }
    }
}

/// Places the vertices where the scene's moment moves them. Returns whether any mesh has moved.
bool World::follow_meshes(const Scene& scene, WorldUpdate& update) {
    PoseRecords pose = meshes_.pose_of(scene);
    for (const std::size_t mesh : meshes_.moved_by(scene, pose)) {
        update.moved.push_back({.mesh = mesh, .before = meshes_.boxes(scene)[mesh]});
        last_moved_[mesh] = revision_ + 1;
    }
    if (!update.moved.empty()) {
        update.uploaded_bytes += meshes_.upload_pose(std::move(pose));
        meshes_.place(positions_, normals_ ? &normals_ : nullptr);
    }
    upload_turned(scene, update);
    return !update.moved.empty() || update.turned_meshes > 0;
}

/// The bounding box of the scene's triangles.
Bounds World::box(const Scene& scene) {
    Bounds box = box_at_rest_;
    if (!meshes_.empty()) {
        for (const Bounds& of_mesh : meshes_.boxes(scene)) {
            box.low = glm::min(box.low, of_mesh.low);
            box.high = glm::max(box.high, of_mesh.high);
        }
    }
    return box;
}

/// The triangles that emit light: found anew only where other materials do.
const std::vector<std::uint32_t>& World::shining(const Scene& scene) {
    std::vector<bool> emitting = which_emit(scene);
    if (emitting != emitting_) {
        shining_ = triangles_of(scene, emitting);
        emissive_ = nullptr;
        emitting_ = std::move(emitting);
    }
    return shining_;
}

void World::upload_changed_materials(const Scene& scene, WorldUpdate& update) {
    const std::vector<MaterialRecord> records = material_records(scene, surfaces_.solids);
    for (std::size_t i = 0; i < records.size(); ++i) {
        if (have_same_bits(records[i], uploaded_materials_[i])) {
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
    update.refitted = !meshes_.empty() && follow_meshes(scene, update);
    if (update.uploaded_bytes > 0) {
        areas_.reset();
        ++revision_;
    }
    if (update.changed_materials > 0) {
        last_material_change_ = revision_;
    }
    if (!update.refitted) {
        return update;
    }
    if (!tracer_.kdtree && !(cost_of_build_ > 0)) {
        cost_of_build_ = traversal_cost(device_, bvh_);
    }
    if (!tracer_.kdtree) {
        refit_triangle_bvh(device_, bvh_, positions_, triangles_);
    }
    for (MovedMesh& moved : update.moved) {
        moved.after = meshes_.boxes(scene)[moved.mesh];
    }
    const double cost = tracer_.kdtree ? 0 : traversal_cost(device_, bvh_);
    tree_cost_ = cost_of_build_ > 0 && !tracer_.kdtree ? cost / cost_of_build_ : 1;
    if (tracer_.kdtree || cost > most_growth * cost_of_build_) {
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
        PhotonSurfaces surfaces = find_photon_surfaces(device_, scene, positions_, triangles_,
                                                       box(scene), follow_roughness);
        SampledAreas sampled = sample_areas(device_, surfaces, {});
        areas_ = {follow_roughness, std::move(surfaces), std::move(sampled)};
    }
    on_device.photon_surfaces = areas_->surfaces;
    on_device.areas = areas_->sampled;
    on_device.surface_area = areas_->sampled.area;
}

DeviceScene World::without_areas(const Scene& scene, const Plan& plan) {
    const StageScope stage(device_, "upload scene");
    if (plan.needs(Feature::smooth_normals) && !normals_) {
        normals_ = upload(device_, "normals", padded(scene.normals));
        if (!meshes_.empty()) {
            meshes_.place(positions_, &normals_);
        }
    }
    DeviceScene result;
    result.plan = plan;
    result.positions = positions_;
    result.normals = plan.needs(Feature::smooth_normals) ? normals_ : unneeded(device_);
    result.triangles = triangles_;
    result.materials = materials_;
    result.bvh = bvh_;
    result.last_material_change = last_material_change_;
    result.meshes.reserve(last_moved_.size());
    for (std::size_t i = 0; i < last_moved_.size(); ++i) {
        result.meshes.push_back({meshes_.boxes(scene)[i], last_moved_[i]});
    }
    add_textures(scene, result);
    const std::vector<std::uint32_t>& shines = shining(scene);
    if (shines.size() > most_lights_on_host || meshes_.have_any(emitting_)) {
        if (!emissive_) {
            emissive_ = std::make_shared<const EmissiveParts>(
                find_emissive_parts(device_, scene, shines, textures_.trees));
        }
        result.emissive = emissive_;
    }
    add_sky(scene, result);
    prepare_scene(device_, scene, box(scene), shines, textures_.trees, result);
    if (plan.needs(Feature::alpha)) {
        result.bvh.alpha = alpha_surfaces(result);
    }
    return result;
}

void World::add_textures(const Scene& scene, DeviceScene& on_device) {
    const bool textured = on_device.plan.needs(Feature::textures) && !scene.textures.empty();
    const bool colored = on_device.plan.needs(Feature::vertex_colors) && !scene.colors.empty();
    if (textured && !textures_.texels) {
        textures_ = make_texture_table(device_, scene);
    }
    const bool turned = on_device.plan.needs(Feature::anisotropy) && !scene.tangents.empty();
    const bool reads_attributes = textured || colored || turned;
    if (reads_attributes && !attributes_) {
        attributes_ = upload_attributes(device_, scene);
    }
    const Buffer none = textured ? Buffer() : unneeded(device_);
    on_device.attributes = reads_attributes ? attributes_ : none;
    on_device.textures = textured ? textures_.records : none;
    on_device.texture_halvings = textured ? textures_.halvings : 0;
    on_device.texels = textured ? textures_.texels : none;
}

void World::add_sky(const Scene& scene, DeviceScene& on_device) {
    if (!on_device.plan.needs(Feature::sky_picture) || scene.sky || !scene.environment) {
        on_device.sky = unneeded(device_);
        return;
    }
    if (!sky_table_ || environment_ != scene.environment) {
        sky_ = Buffer(); // frees its memory before the new one takes its own
        sky_table_ = std::make_shared<const SkyTable>(make_sky_table(
            *scene.environment, device_.info().limits.storage_range / sizeof(std::uint32_t)));
        sky_ = upload(device_, "sky", sky_table_->words);
        environment_ = scene.environment;
    }
    on_device.sky = sky_;
    on_device.sky_table = sky_table_;
}

void World::add_casters(const Scene& scene, DeviceScene& on_device) {
    const Plan& plan = on_device.plan;
    if (!plan.needs_photons() || !plan.needs(Feature::followed_paths)) {
        return;
    }
    std::vector<bool> followed = are_followed(scene, plan.request.follow_roughness);
    if (!casters_ || casters_followed_ != followed) {
        casters_ = std::make_shared<const CasterTable>(make_caster_table(device_, scene, followed));
        casters_followed_ = std::move(followed);
    }
    on_device.casters = casters_;
}

DeviceScene World::on_device(const Scene& scene, const Plan& plan) {
    DeviceScene result = without_areas(scene, plan);
    add_casters(scene, result);
    add_areas(scene, result);
    return result;
}

} // namespace argand
