#pragma once

#include "interactive/camera_motion.hpp"
#include "interactive/view.hpp"

#include <optional>

namespace argand::window {

/// Moves a view's camera as the user drags and flies.
class Navigation {
public:
    /// Call once a frame, after Dear ImGui has begun it. Returns the edit of the camera, if the
    /// user has moved it.
    std::optional<nlohmann::json> move(const View& view);

    /// Whether the user has begun to move it in this frame.
    bool begins() const { return begins_; }
    /// Forgets where the camera is: another scene is shown, or edits were undone.
    void forget() { place_.reset(); }

private:
    std::optional<CameraPlace> place_;
    bool moves_ = false, begins_ = false;
};

} // namespace argand::window
