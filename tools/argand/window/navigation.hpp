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
    /// pointer_is_free: it drags nothing else.
    std::optional<nlohmann::json> move(const View& view, bool pointer_is_free);

    /// Whether the user has begun to move it in this frame.
    bool begins() const { return begins_; }
    /// Forgets how far away what it looks at is: another scene is shown.
    void forget() { place_.reset(); }

private:
    CameraPlace begin(const View& view) const;

    std::optional<CameraPlace> place_; ///< during a motion and after it, until the next one
    bool active_ = false, begins_ = false;
};

} // namespace argand::window
