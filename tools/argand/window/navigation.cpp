#include "navigation.hpp"

#include "keys.hpp"
#include "scene/scene.hpp"

#include <algorithm>
#include <cmath>
#include <imgui.h>
#include <numbers>
#include <string>

namespace argand::window {

namespace {

// Half a turn across 600 pixels.
constexpr double radians_per_pixel = std::numbers::pi / 600;
// Each step of the wheel, and the share of the distance that a second of flight covers.
constexpr double nearer_by_step = 0.9, flight = 0.8;

/// The distance to the middle of the scene, along the camera's axis.
double distance_to_scene(const View& view) {
    const Camera& camera = view.scene().cameras[view.settings().camera];
    const Bounds box = bounds(view.scene());
    const glm::dvec3 middle = (glm::dvec3(box.low) + glm::dvec3(box.high)) / 2.0;
    const double extent = glm::length(glm::dvec3(box.high) - glm::dvec3(box.low));
    const double along = glm::dot(middle - glm::dvec3(camera.position), glm::dvec3(camera.forward));
    return std::max(along, 0.1 * extent);
}

bool is_down(ImGuiKey key) { return ImGui::IsKeyDown(ImGui::GetKeyIndex(key)); }
bool is_letter_down(char letter) { return ImGui::IsKeyDown(static_cast<int>(letter)); }

/// Right, up and forwards, each -1, 0 or 1.
glm::dvec3 keys() {
    const auto axis = [](bool more, bool less) { return double(more) - double(less); };
    return {axis(is_letter_down('D'), is_letter_down('A')),
            axis(is_letter_down('E'), is_letter_down('Q')),
            axis(is_letter_down('W') || is_down(ImGuiKey_UpArrow),
                 is_letter_down('S') || is_down(ImGuiKey_DownArrow))};
}

} // namespace

CameraPlace Navigation::begin(const View& view) const {
    return place_of(view.scene().cameras[view.settings().camera],
                    place_ ? glm::length(place_->target - place_->position)
                           : distance_to_scene(view));
}

std::optional<nlohmann::json> Navigation::move(const View& view, bool pointer_is_free) {
    const ImGuiIO& io = ImGui::GetIO();
    // Between motions others may have moved it: an undo, a script, an animation.
    CameraPlace place = place_ && active_ ? *place_ : begin(view);
    const double distance = glm::length(place.target - place.position);
    bool moves = false;
    // In the frame of a click the pointer came from elsewhere.
    const bool clicked = io.MouseClicked[0] || io.MouseClicked[1] || io.MouseClicked[2];
    const glm::dvec2 drag = io.WantCaptureMouse || !pointer_is_free || clicked
                                ? glm::dvec2(0)
                                : radians_per_pixel * glm::dvec2(io.MouseDelta.x, io.MouseDelta.y);
    if (drag != glm::dvec2(0) && io.MouseDown[0]) {
        place = orbited(place, -drag.x, drag.y);
        moves = true;
    } else if (drag != glm::dvec2(0) && io.MouseDown[1]) {
        place = turned(place, drag.x, -drag.y);
        moves = true;
    } else if (drag != glm::dvec2(0) && io.MouseDown[2]) {
        place = shifted(place, distance * glm::dvec3(-drag.x, drag.y, 0));
        moves = true;
    }
    if (!io.WantCaptureMouse && io.MouseWheel != 0) {
        place = approached(place, std::pow(nearer_by_step, double(io.MouseWheel)));
        moves = true;
    }
    if (const glm::dvec3 flown = io.WantCaptureKeyboard || io.KeyCtrl ? glm::dvec3(0) : keys();
        flown != glm::dvec3(0)) {
        // A slow frame must not become a leap.
        place = shifted(place, flight * distance * std::min(double(io.DeltaTime), 0.25) * flown);
        moves = true;
    }
    // A pointer that rests while its button is down has not ended its motion.
    const bool held = io.MouseDown[0] || io.MouseDown[1] || io.MouseDown[2];
    begins_ = moves && !active_;
    active_ = moves || (active_ && held);
    if (!moves) {
        return {};
    }
    place_ = place;
    return nlohmann::json{
        {"cameras",
         {{key_in(view.edits(), "cameras", view.scene().cameras, view.settings().camera),
           edit_of(place)}}}};
}

} // namespace argand::window
