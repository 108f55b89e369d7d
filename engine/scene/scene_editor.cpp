#include "scene/scene_editor.hpp"

#include "base/error.hpp"
#include "base/text.hpp"
#include "scene/direction.hpp"
#include "scene/factors.hpp"
#include "scene/find_named.hpp"
#include "scene/placement.hpp"
#include "scene/pose.hpp"
#include "scene/solids.hpp"
#include "scene/studio.hpp"

#include <algorithm>
#include <glm/gtc/constants.hpp>
#include <string>

namespace argand {

namespace {

/// The index of the object of a kind that edits name.
template <class Range>
std::size_t find(const Range& objects, const std::string& choice, const char* kind,
                 const Scene& scene) {
    if (const std::optional<std::size_t> index = find_named(objects, choice)) {
        return *index;
    }
    fail("editing '{}': there is no {} of the name or index '{}'; `argand inspect` lists them",
         scene.name, kind, one_line(choice, 60));
}

MotionNode& find_node(Scene& scene, const std::string& choice) {
    std::vector<MotionNode>& nodes = scene.motion.nodes;
    auto found = std::find_if(nodes.begin(), nodes.end(),
                              [&](const MotionNode& node) { return node.name == choice; });
    if (found == nodes.end()) {
        found = std::find_if(nodes.begin(), nodes.end(), [&](const MotionNode& node) {
            return std::to_string(node.index) == choice;
        });
    }
    if (found == nodes.end()) {
        fail("editing '{}': there is no node of the name or index '{}'; `argand inspect` lists "
             "those that show something",
             scene.name, one_line(choice, 60));
    }
    if (!found->movable) {
        fail("editing '{}': node '{}' cannot be moved; load the scene with movable nodes",
             scene.name, one_line(choice, 60));
    }
    return *found;
}

/// Takes the object of this index from those that move, after it has come to rest.
template <class Moving, class Rest>
void stop(std::vector<Moving>& moving, std::size_t index, const Rest& come_to_rest) {
    const auto found = std::find_if(moving.begin(), moving.end(),
                                    [&](const Moving& object) { return object.index == index; });
    if (found != moving.end()) {
        come_to_rest(*found);
        moving.erase(found);
    }
}

void edit_light(const LightEdit& edit, std::size_t index, const Pose& rest, Scene& scene) {
    Light& light = scene.lights[index];
    stop(scene.motion.lights, index, [&](const MovingLight& moving) {
        light = moving.light;
        set_factors(moving.factors, light);
        if (!place(rest.world_from_node[moving.node], light)) {
            light.intensity = glm::vec3(0);
        }
    });
    if ((edit.position && light.kind == LightKind::directional) ||
        (edit.direction && light.kind == LightKind::point)) {
        fail("editing '{}': light '{}' has no {}; leave that out", scene.name, light.name,
             edit.position ? "position, as it is infinitely far away" : "direction");
    }
    light.position = edit.position.value_or(light.position);
    light.direction = edit.direction.value_or(light.direction);
    light.intensity = edit.intensity.value_or(light.intensity);
}

template <class T> void set(T& value, const std::optional<double>& edited) {
    value = static_cast<T>(edited.value_or(value));
}

void edit_material(const MaterialEdit& edit, std::size_t index, Scene& scene) {
    Material& material = scene.materials[index];
    stop(scene.motion.materials, index,
         [&](const MovingMaterial& moving) { set_factors(moving.factors, material); });
    if (edit.base_color) {
        material.base_color = *edit.base_color;
        if (material.phong) { // together they reflect at most all light
            material.base_color = glm::min(material.base_color, 1.0f - material.phong->specular);
        }
    }
    if (edit.emission && !material.unlit) { // of which only the base colour counts
        material.emission = glm::vec3(*edit.emission) * material.coverage;
    }
    set(material.metallic, edit.metallic);
    set(material.roughness, edit.roughness);
    set(material.specular, edit.specular);
    set(material.transmission, edit.transmission);
    set(material.ior, edit.ior);
    set(material.coat, edit.coat);
    set(material.coat_roughness, edit.coat_roughness);
}

void edit_camera(const CameraEdit& edit, std::size_t index, const Pose& rest, Scene& scene) {
    Camera& camera = scene.cameras[index];
    stop(scene.motion.cameras, index, [&](const MovingCamera& moving) {
        camera = moving.camera;
        place(rest.world_from_node[moving.node], camera);
    });
    const glm::dvec3 position = edit.position.value_or(glm::dvec3(camera.position));
    const glm::dvec3 forward =
        edit.target ? unit_or_zero(*edit.target - position) : glm::dvec3(camera.forward);
    const glm::dvec3 right =
        unit_or_zero(glm::cross(forward, edit.up.value_or(glm::dvec3(camera.up))));
    if (right == glm::dvec3(0)) {
        fail("editing '{}': camera '{}' has no direction, or one along its own 'up'; move its "
             "'target', or turn 'up'",
             scene.name, camera.name);
    }
    camera.position = position;
    if (edit.target || edit.up) {
        camera.forward = forward;
        camera.right = right;
        camera.up = glm::cross(right, forward);
    }
    if (edit.vertical_angle && camera.kind == CameraKind::orthographic) {
        fail("editing '{}': camera '{}' is orthographic and has no vertical_angle; leave that out",
             scene.name, camera.name);
    }
    if (edit.vertical_angle) {
        camera.vertical_angle = static_cast<float>(glm::radians(*edit.vertical_angle));
    }
}

bool same(const SunPosition& a, const SunPosition& b) {
    return a.elevation == b.elevation && a.azimuth == b.azimuth && a.turbidity == b.turbidity;
}

} // namespace

SceneEditor::SceneEditor(const Scene& scene)
    : lights_(scene.lights), cameras_(scene.cameras), materials_(scene.materials),
      solids_(scene.solids), sky_(scene.sky), environment_(scene.environment),
      nodes_(scene.motion.nodes), moving_lights_(scene.motion.lights),
      moving_cameras_(scene.motion.cameras), moving_materials_(scene.motion.materials) {}

void SceneEditor::restore(Scene& scene) const {
    scene.lights = lights_;
    scene.cameras = cameras_;
    scene.materials = materials_;
    scene.solids = solids_;
    scene.sky = sky_;
    scene.environment = environment_;
    scene.motion.nodes = nodes_;
    scene.motion.lights = moving_lights_;
    scene.motion.cameras = moving_cameras_;
    scene.motion.materials = moving_materials_;
}

void SceneEditor::edit_nodes(const Edits& edits, Scene& scene) const {
    for (const auto& [choice, edit] : edits.nodes) {
        MotionNode& node = find_node(scene, choice);
        LocalTransform& rest = node.rest;
        if (rest.matrix && (edit.rotation || edit.scale)) {
            fail("editing '{}': node '{}' has a matrix, whose rotation and scale cannot be "
                 "replaced; give it these two in the file instead, or edit its translation only",
                 scene.name, one_line(choice, 60));
        }
        if (edit.translation) {
            rest.translation = *edit.translation;
            if (rest.matrix) {
                (*rest.matrix)[3] = glm::dvec4(*edit.translation, 1);
            }
            node.keys.translation.reset();
        }
        if (edit.rotation) {
            rest.rotation = *edit.rotation;
            node.keys.rotation.reset();
        }
        if (edit.scale) {
            rest.scale = *edit.scale;
            node.keys.scale.reset();
        }
    }
}

/// Ranks of the solids of the edited materials, in the places that the file gives them: as after
/// loading, they depend neither on the moment nor on where nodes have been moved.
SolidRanks SceneEditor::ranks_at_rest(const Scene& scene) const {
    Scene at_rest = scene;
    at_rest.motion.nodes = nodes_;
    move_to({}, at_rest);
    return solid_ranks(at_rest);
}

void SceneEditor::apply(const Edits& edits, Scene& scene) {
    restore(scene);
    edit_nodes(edits, scene);
    move_without_vertices(scene.seconds, scene);
    const Pose rest = pose_at(scene.motion, {});
    for (const auto& [choice, edit] : edits.lights) {
        edit_light(edit, find(scene.lights, choice, "light", scene), rest, scene);
    }
    bool bounds_change = false;
    for (const auto& [choice, edit] : edits.materials) {
        const std::size_t index = find(scene.materials, choice, "material", scene);
        edit_material(edit, index, scene);
        const Material &before = materials_[index], &now = scene.materials[index];
        bounds_change |= before.transmission != now.transmission ||
                         before.metallic != now.metallic || before.ior != now.ior;
    }
    if (bounds_change) {
        scene.solids = ranks_at_rest(scene);
    }
    for (const auto& [choice, edit] : edits.cameras) {
        edit_camera(edit, find(scene.cameras, choice, "camera", scene), rest, scene);
    }
    if (edits.sun) {
        if (!sun_ || !same(sun_->first, *edits.sun)) {
            sun_.emplace(*edits.sun, sun_and_sky(*edits.sun));
        }
        replace_sky(scene, sun_->second);
    }
}

} // namespace argand
