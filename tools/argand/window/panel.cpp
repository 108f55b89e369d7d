#include "panel.hpp"

#include "keys.hpp"
#include "methods/method_info.hpp"

#include <algorithm>
#include <array>
#include <imgui.h>
#include <utility>

namespace argand::window {

namespace {

using nlohmann::json;

constexpr std::size_t most_undone = 200;

std::array<float, 3> floats(const glm::vec3& v) { return {v.x, v.y, v.z}; }

/// Applies what widgets change. What one widget changes while it is held is undone together.
class Changes {
public:
    Changes(View& view, PanelState& state) : view_(view), state_(state) {}

    /// Call after each widget. patch: made if the widget has changed its value.
    template <class Patch> void after(bool changed, const Patch& patch) {
        if (ImGui::IsItemActivated()) {
            remember(view_, state_);
        }
        if (changed) {
            attempt(state_, [&] { view_.edit(patch()); });
        }
    }

private:
    View& view_;
    PanelState& state_;
};

void draw_method(View& view, PanelState& state) {
    const RenderSettings settings = view.settings();
    const MethodTable methods = view.methods();
    if (ImGui::BeginCombo("method", settings.method.c_str())) {
        for (const MethodInfo& method : methods) {
            if (ImGui::Selectable(method.name.c_str(), method.name == settings.method)) {
                attempt(state, [&] { view.set_method(method.name); });
            }
            if (ImGui::IsItemHovered()) {
                ImGui::SetTooltip("%s", method.summary.c_str());
            }
        }
        ImGui::EndCombo();
    }
    if (!ImGui::CollapsingHeader("options")) {
        return;
    }
    for (const Option& option : methods.at(settings.method).options) {
        if (option.ends_render) {
            continue;
        }
        const std::string value = option.get(settings);
        std::string wanted = value;
        if (option.kind == OptionKind::flag) {
            bool on = value == "on";
            if (ImGui::Checkbox(option.name.c_str(), &on)) {
                wanted = on ? "on" : "off";
            }
        } else if (option.kind == OptionKind::choice) {
            if (ImGui::BeginCombo(option.name.c_str(), value.c_str())) {
                for (const std::string& choice : option.choices) {
                    if (ImGui::Selectable(choice.c_str(), choice == value)) {
                        wanted = choice;
                    }
                }
                ImGui::EndCombo();
            }
        } else {
            std::array<char, 32> text{};
            value.copy(text.data(), text.size() - 1);
            if (ImGui::InputText(option.name.c_str(), text.data(), text.size(),
                                 ImGuiInputTextFlags_EnterReturnsTrue)) {
                wanted = text.data();
            }
        }
        if (ImGui::IsItemHovered()) {
            ImGui::SetTooltip("%s", option.help.c_str());
        }
        if (wanted != value) {
            attempt(state, [&] { view.set_option(option.name, wanted); });
        }
    }
}

void draw_lights(View& view, Changes& changes) {
    if (!ImGui::CollapsingHeader("lights", ImGuiTreeNodeFlags_DefaultOpen)) {
        return;
    }
    const std::vector<Light> lights = view.scene().lights;
    for (std::size_t i = 0; i < lights.size(); ++i) {
        const std::string key = key_in(view.edits(), "lights", lights, i);
        ImGui::PushID(static_cast<int>(i));
        ImGui::TextUnformatted(key.c_str());
        const auto edit = [&](const char* member, const std::array<float, 3>& value) {
            return json{{"lights", {{key, {{member, value}}}}}};
        };
        if (lights[i].kind != LightKind::directional) {
            std::array<float, 3> position = floats(lights[i].position);
            const bool moved = ImGui::DragFloat3("position", position.data(), 0.01f);
            changes.after(moved, [&] { return edit("position", position); });
        }
        if (lights[i].kind != LightKind::point) {
            std::array<float, 3> direction = floats(lights[i].direction);
            const bool turned = ImGui::DragFloat3("direction", direction.data(), 0.01f);
            changes.after(turned, [&] { return edit("direction", direction); });
        }
        std::array<float, 3> intensity = floats(lights[i].intensity);
        const bool changed = ImGui::DragFloat3("intensity", intensity.data(), 0.05f, 0, 1e6f,
                                               "%.3g", ImGuiSliderFlags_Logarithmic);
        changes.after(changed, [&] { return edit("intensity", intensity); });
        ImGui::PopID();
    }
}

void draw_sun(View& view, Changes& changes) {
    if (!ImGui::CollapsingHeader("sun")) {
        return;
    }
    const json sun = view.edits().value("sun", json::object());
    const SunPosition usual;
    auto elevation = static_cast<float>(sun.value("elevation", usual.elevation));
    auto azimuth = static_cast<float>(sun.value("azimuth", usual.azimuth));
    const auto patch = [&] {
        return json{{"sun", {{"elevation", elevation}, {"azimuth", azimuth}}}};
    };
    changes.after(ImGui::SliderFloat("elevation", &elevation, -10, 90), patch);
    changes.after(ImGui::SliderFloat("azimuth", &azimuth, 0, 360), patch);
}

void draw_materials(View& view, Changes& changes) {
    if (!ImGui::CollapsingHeader("materials")) {
        return;
    }
    const std::vector<Material> materials = view.scene().materials;
    for (std::size_t i = 0; i < materials.size(); ++i) {
        const Material& material = materials[i];
        const std::string key = key_in(view.edits(), "materials", materials, i);
        if (!ImGui::TreeNode(reinterpret_cast<void*>(i), "%s", key.c_str())) {
            continue;
        }
        const auto edit = [&](const char* member, const json& value) {
            return json{{"materials", {{key, {{member, value}}}}}};
        };
        std::array<float, 3> color = floats(material.base_color);
        const bool colored =
            ImGui::ColorEdit3("base colour", color.data(), ImGuiColorEditFlags_Float);
        changes.after(colored, [&] { return edit("base_color", color); });
        // The scene's is that of the part of the surface that is there.
        std::array<float, 3> emission = floats(
            material.coverage > 0 ? material.emission / material.coverage : material.emission);
        const bool shines = ImGui::DragFloat3("emission", emission.data(), 0.05f, 0, 1e6f);
        changes.after(shines, [&] { return edit("emission", emission); });
        for (const auto& [member, value] :
             {std::pair{"metallic", material.metallic}, std::pair{"roughness", material.roughness},
              std::pair{"transmission", material.transmission}}) {
            float changed = value;
            const bool moved = ImGui::SliderFloat(member, &changed, 0, 1);
            changes.after(moved, [&, of = member] { return edit(of, changed); });
        }
        ImGui::TreePop();
    }
}

void draw_objects(View& view, Changes& changes) {
    if (!ImGui::CollapsingHeader("objects")) {
        return;
    }
    const std::vector<SceneObject> objects = view.scene().objects;
    const std::vector<MotionNode> nodes = view.scene().motion.nodes;
    for (const SceneObject& object : objects) {
        const std::string key = key_of_object(view.edits(), object);
        const std::string label = object.name.empty() ? "node " + key : object.name;
        const auto node =
            std::find_if(nodes.begin(), nodes.end(), [&](const MotionNode& candidate) {
                return candidate.index == object.node && candidate.movable;
            });
        ImGui::PushID(static_cast<int>(object.node));
        if (node == nodes.end()) { // what nodes need to move is not loaded yet
            const bool asked = ImGui::Button("move");
            changes.after(asked, [&] { return json{{"nodes", {{key, json::object()}}}}; });
            ImGui::SameLine();
            ImGui::TextUnformatted(label.c_str());
        } else {
            std::array<float, 3> to = floats(glm::vec3(node->rest.translation));
            const bool moved = ImGui::DragFloat3(label.c_str(), to.data(), 0.01f);
            changes.after(moved, [&] { return json{{"nodes", {{key, {{"translation", to}}}}}}; });
        }
        ImGui::PopID();
    }
}

void draw_time(View& view, PanelState& state) {
    const double longest = longest_animation(view.scene());
    if (view.scene().animations.empty() || !(longest > 0)) {
        return;
    }
    auto seconds = static_cast<float>(view.time().value_or(0));
    if (ImGui::SliderFloat("time", &seconds, 0, static_cast<float>(longest), "%.2f s")) {
        attempt(state, [&] { view.set_time(seconds); });
    }
    ImGui::SameLine();
    ImGui::Checkbox("play", &state.plays);
}

/// Returns whether anything has changed.
bool draw_display(PictureOptions& picture) {
    if (!ImGui::CollapsingHeader("display")) {
        return false;
    }
    bool changed = ImGui::Checkbox("automatic", &picture.automatic);
    ImGui::SameLine();
    changed |= ImGui::SliderFloat("exposure", &picture.exposure, -16, 16, "%.1f stops");
    const std::string tone(name_of(picture.tone));
    if (ImGui::BeginCombo("tone", tone.c_str())) {
        for (const Tone choice : {Tone::linear, Tone::neutral, Tone::filmic}) {
            if (ImGui::Selectable(std::string(name_of(choice)).c_str(), choice == picture.tone)) {
                picture.tone = choice;
                changed = true;
            }
        }
        ImGui::EndCombo();
    }
    return changed;
}

void draw_help() {
    if (ImGui::CollapsingHeader("keys")) {
        ImGui::TextUnformatted("drag             orbit; a circle: what it is on\n"
                               "right drag       look around\n"
                               "middle drag      shift\n"
                               "wheel            nearer, farther\n"
                               "W A S D Q E      fly\n"
                               "Space            play, pause\n"
                               "Ctrl+Z           undo\n"
                               "F2               screenshot\n"
                               "F5               read the file again\n"
                               "Tab              hide the panel\n"
                               "drop a file      open it");
    }
}

} // namespace

void remember(const View& view, PanelState& state) {
    state.message.clear(); // of what the user did before
    state.undo.push_back(view.edits());
    if (state.undo.size() > most_undone) {
        state.undo.pop_front();
    }
}

void undo(View& view, PanelState& state) {
    while (!state.undo.empty()) {
        const json before = std::move(state.undo.back());
        state.undo.pop_back();
        if (before != view.edits()) { // else the change was none
            attempt(state, [&] { view.set_edits(before); });
            return;
        }
    }
}

PanelWishes draw_panel(View& view, PanelState& state) {
    PanelWishes wishes;
    Changes changes(view, state);
    ImGui::SetNextWindowPos({8, 8}, ImGuiCond_FirstUseEver);
    ImGui::SetNextWindowSize({320, 440}, ImGuiCond_FirstUseEver);
    ImGui::Begin("argand");
    const ViewFrame& frame = state.frame;
    ImGui::Text("%s %dx%d, %.1f ms", frame.moving ? "preview" : "at rest", frame.width,
                frame.height, 1e3 * frame.seconds);
    ImGui::Text("%llu photons, %llu passes", static_cast<unsigned long long>(frame.photons),
                static_cast<unsigned long long>(frame.passes));
    if (!state.message.empty()) {
        ImGui::PushStyleColor(ImGuiCol_Text, {1, 0.5f, 0.4f, 1});
        ImGui::TextWrapped("%s", state.message.c_str());
        ImGui::PopStyleColor();
    }
    wishes.screenshot = ImGui::Button("screenshot");
    ImGui::SameLine();
    wishes.save_edits = ImGui::Button("save edits");
    ImGui::SameLine();
    if (ImGui::Button("undo")) {
        undo(view, state);
    }
    ImGui::SameLine();
    wishes.copy_command = ImGui::Button("copy command");
    draw_time(view, state);
    draw_method(view, state);
    draw_lights(view, changes);
    draw_objects(view, changes);
    draw_materials(view, changes);
    draw_sun(view, changes);
    draw_help();
    wishes.changes_display = draw_display(state.picture);
    const ImVec2 corner = ImGui::GetWindowPos(), size = ImGui::GetWindowSize();
    wishes.rectangle = {corner.x, corner.y, corner.x + size.x, corner.y + size.y};
    ImGui::End();
    return wishes;
}

} // namespace argand::window
