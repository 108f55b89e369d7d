#include "base/clock.hpp"
#include "scene/framing.hpp"
#include "scene/gltf.hpp"
#include "scene/gltf_animation.hpp"
#include "scene/gltf_camera.hpp"
#include "scene/gltf_extensions.hpp"
#include "scene/gltf_file.hpp"
#include "scene/gltf_light.hpp"
#include "scene/gltf_material.hpp"
#include "scene/gltf_mesh.hpp"
#include "scene/gltf_node.hpp"
#include "scene/gltf_uri.hpp"
#include "scene/moving_factors.hpp"
#include "scene/pose.hpp"
#include "scene/solids.hpp"
#include "scene/studio.hpp"
#include "shared/solids.h"
#include "shared/texture_record.h"
#include <algorithm>
#include <fmt/format.h>
#include <utility>

namespace argand {
namespace {

/// Whether a material's surfaces light the others, now or at another time. Displays and the like,
/// which shine by texels no brighter than white, are seen but do not.
bool is_lamp(const Scene& scene, std::uint32_t index) {
    const Material& material = scene.materials[index];
    const bool glows = (material.texture_bits & material_emissive_texture) != 0 &&
                       moving_material(scene.motion, index) == nullptr &&
                       glm::all(glm::lessThanEqual(material.emission, glm::vec3(1)));
    return may_emit(scene, index) && !glows;
}

/// Adds a studio where the file has no light.
void add_missing_light(Scene& scene) {
    const bool emissive =
        std::any_of(scene.triangle_material.begin(), scene.triangle_material.end(),
                    [&](std::uint32_t material) { return is_lamp(scene, material); });
    if (scene.lights.empty() && !emissive) {
        add_studio(scene);
    }
}

bool has_area(const Scene& scene) {
    for (std::size_t i = 0; i < scene.triangles.size(); ++i) {
        if (area(scene, i) > 0) {
            return true;
        }
    }
    return false;
}

/// Keeps nodes and skins only if something moves.
void forget_what_rests(Scene& scene) {
    const Motion& motion = scene.motion;
    if (motion.meshes.empty() && motion.lights.empty() && motion.cameras.empty() &&
        motion.materials.empty()) {
        scene.motion = {};
    }
}

/// What a camera that is added sees: the scene at rest, or if that is a point, in the middle of its
/// animations. So the camera stands still while objects move.
Bounds bounds_to_frame(const Scene& scene) {
    const Bounds at_rest = bounds(scene);
    if (at_rest.low != at_rest.high) {
        return at_rest;
    }
    Scene moved = scene;
    move_to(longest_animation(scene) / 2, moved);
    return bounds(moved);
}

void add_notes_on_solids(Scene& scene) {
    if (const std::size_t solids = scene.solids->materials.size(); solids > most_ranked_solids) {
        add_note(scene, fmt::format("{} materials bound solids; overlaps are resolved for {} of "
                                    "them: the least priority, then the largest volume",
                                    solids, most_ranked_solids));
    }
    if (const std::vector<std::uint32_t> thin = thin_bodies(scene); !thin.empty()) {
        const std::string& name = scene.materials[thin[0]].name;
        add_note(scene, fmt::format(
                            "{}{} bounds a body and transmits light, but has no thickness "
                            "(KHR_materials_volume): it is a thin wall, which does not refract",
                            label("material", static_cast<int>(thin[0]), name),
                            thin.size() > 1 ? fmt::format(" (and {} more)", thin.size() - 1) : ""));
    }
}

} // namespace

Scene load_gltf(const std::filesystem::path& path, std::optional<double> seconds,
                const LoadOptions& options) {
    Scene scene;
    Clock::time_point start = Clock::now();
    const auto end_step = [&](const char* name) {
        scene.load_seconds.emplace_back(name, seconds_since(start));
        start = Clock::now();
    };
    const GltfSource source = read_gltf_file(path, options, scene.notes);
    end_step("file");
    scene.name = one_line(path.filename().string());
    scene.files = files_of_uris(source.directory, source.root);
    scene.seconds = seconds;
    add_extensions(source, scene);
    FileKeys keys = read_animations(source, scene);
    if (seconds && scene.animations.empty()) {
        add_note(scene, "there is no animation: the scene is the same at any time");
    }
    const std::vector<GltfNode> nodes =
        read_nodes(source, options.scene, std::move(keys.nodes), scene);
    add_materials(source, std::move(keys.materials), scene);
    end_step("materials and images");
    add_lights(source, nodes, std::move(keys.lights), scene);
    add_cameras(source, nodes, std::move(keys.cameras), scene);
    add_meshes(source, nodes, scene);
    end_step("meshes");
    add_missing_light(scene);
    forget_what_rests(scene);
    scene.solids = solid_ranks(scene);
    add_notes_on_solids(scene);
    const Bounds to_frame = scene.cameras.empty() ? bounds_to_frame(scene) : Bounds();
    if (seconds) {
        move_to(*seconds, scene);
    }
    // What has no area now may have some at another time.
    if (!has_area(scene) && scene.motion.meshes.empty()) {
        source.fail(
            "there is nothing to render: it shows no triangle that has an area and can be seen");
    }
    if (scene.cameras.empty()) {
        scene.cameras.push_back(frame_bounds(to_frame));
        add_note(scene, scene.motion.meshes.empty()
                            ? "there is no camera: one that sees the whole scene is added"
                            : "there is no camera: one that sees the whole scene at rest is added");
    }
    return scene;
}

} // namespace argand
