#include "handles.hpp"

#include "keys.hpp"
#include "scene/objects.hpp"
#include "scene/pose.hpp"

#include <algorithm>

namespace argand::window {

namespace {

using nlohmann::json;

constexpr float radius = 7;
constexpr ImU32 plain = IM_COL32(255, 255, 255, 180), lit = IM_COL32(255, 200, 60, 255);

/// The middle of the bounding box of an object's triangles, where the host has them.
glm::dvec3 middle_of(const Scene& scene, std::size_t object) {
    const std::size_t end = end_of_object(scene, object);
    Bounds box;
    for (std::size_t i = scene.objects[object].first_triangle; i < end; ++i) {
        for (int corner = 0; corner < 3; ++corner) {
            const glm::vec3& p = scene.positions[scene.triangles[i][corner]];
            box.low = glm::min(box.low, p);
            box.high = glm::max(box.high, p);
        }
    }
    return (glm::dvec3(box.low) + glm::dvec3(box.high)) / 2.0;
}

} // namespace

void Handles::add_objects(const View& view, std::vector<Handle>& handles) {
    const Scene& scene = view.scene();
    const std::vector<MotionNode>& nodes = scene.motion.nodes;
    if (nodes.empty() || !nodes.front().movable) {
        return;
    }
    const Pose now = pose_at(scene.motion, scene.seconds);
    // The host's vertices are those of the file: edits move only the device's.
    std::optional<Pose> loaded;
    for (std::size_t object = 0; object < scene.objects.size(); ++object) {
        const std::uint32_t index = scene.objects[object].node;
        const auto node = std::find_if(nodes.begin(), nodes.end(), [&](const MotionNode& n) {
            return n.index == index && n.movable;
        });
        if (node == nodes.end()) {
            continue;
        }
        const auto number = static_cast<std::size_t>(node - nodes.begin());
        if (!anchors_.contains(index)) {
            if (!loaded) {
                Motion unedited = scene.motion;
                unedited.nodes = view.unedited_nodes();
                loaded = pose_at(unedited, scene.seconds);
            }
            anchors_[index] = glm::dvec3(glm::inverse(loaded->world_from_node[number]) *
                                         glm::dvec4(middle_of(scene, object), 1));
        }
        const glm::dmat4 world_from_parent =
            node->parent < 0 ? glm::dmat4(1)
                             : now.world_from_node[static_cast<std::size_t>(node->parent)];
        handles.push_back(
            {.kind = "nodes",
             .key = key_of_object(view.edits(), scene.objects[object]),
             .label = scene.objects[object].name.empty() ? "node " + std::to_string(index)
                                                         : scene.objects[object].name,
             .place = glm::dvec3(now.world_from_node[number] * glm::dvec4(anchors_[index], 1)),
             .value =
                 node->rest.matrix ? glm::dvec3((*node->rest.matrix)[3]) : node->rest.translation,
             .value_from_world = glm::inverse(glm::dmat3(world_from_parent))});
    }
}

std::vector<Handles::Handle> Handles::find(const View& view) {
    std::vector<Handle> handles;
    const std::vector<Light>& lights = view.scene().lights;
    for (std::size_t i = 0; i < lights.size(); ++i) {
        if (lights[i].kind != LightKind::directional) {
            const glm::dvec3 place(lights[i].position);
            handles.push_back({.kind = "lights",
                               .key = key_in(view.edits(), "lights", lights, i),
                               .label = lights[i].name,
                               .place = place,
                               .value = place});
        }
    }
    add_objects(view, handles);
    return handles;
}

std::optional<json> Handles::drag(const View& view, ImVec2 low, ImVec2 high) {
    const ImGuiIO& io = ImGui::GetIO();
    const glm::dvec2 corner(low.x, low.y), size(high.x - low.x, high.y - low.y);
    begins_ = false;
    if (!io.MouseDown[0]) {
        dragged_.clear();
    }
    if (!(size.x > 0) || !(size.y > 0)) {
        return {};
    }
    const Projection projection(view.scene().cameras[view.settings().camera], size.x / size.y);
    std::optional<json> edit;
    for (const Handle& handle : find(view)) {
        const std::optional<glm::dvec2> at = projection.of(handle.place);
        if (!at) {
            continue;
        }
        const glm::dvec2 pixel = corner + *at * size;
        const ImVec2 middle(static_cast<float>(pixel.x), static_cast<float>(pixel.y));
        const bool is_near =
            glm::distance(pixel, glm::dvec2(io.MousePos.x, io.MousePos.y)) < radius;
        const std::string name = handle.kind + handle.key;
        if (is_near && dragged_.empty() && io.MouseClicked[0] && !io.WantCaptureMouse) {
            dragged_ = name;
            begins_ = true;
        }
        const bool is_dragged = dragged_ == name;
        ImDrawList* over = ImGui::GetBackgroundDrawList();
        over->AddCircle(middle, radius, IM_COL32(0, 0, 0, 160), 0, 3);
        over->AddCircle(middle, radius, is_dragged || is_near ? lit : plain, 0, 1.5f);
        if (is_near && !io.WantCaptureMouse) {
            over->AddText({middle.x + radius + 4, middle.y - radius}, lit, handle.label.c_str());
        }
        const glm::dvec2 by = glm::dvec2(io.MouseDelta.x, io.MouseDelta.y) / size;
        if (is_dragged && !begins_ && by != glm::dvec2(0)) {
            const glm::dvec3 to =
                handle.value + handle.value_from_world * projection.moved(handle.place, by);
            const char* member = handle.kind == "lights" ? "position" : "translation";
            edit = json{{handle.kind, {{handle.key, {{member, {to.x, to.y, to.z}}}}}}};
        }
    }
    return edit;
}

} // namespace argand::window
