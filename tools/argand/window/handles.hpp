#pragma once

#include "interactive/projection.hpp"
#include "interactive/view.hpp"

#include <imgui.h>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace argand::window {

/// Circles on lights, and on objects that can be moved, by which the pointer drags them in parallel
/// to the picture.
class Handles {
public:
    /// Draws them over a picture between these corners. Returns the edit of what is dragged, if it
    /// has moved.
    std::optional<nlohmann::json> drag(const View& view, ImVec2 low, ImVec2 high);

    /// Whether something is dragged, and whether that begins in this frame.
    bool drags() const { return !dragged_.empty(); }
    bool begins() const { return begins_; }
    /// Lets go of what is dragged.
    void release() {
        dragged_.clear();
        begins_ = false;
    }
    /// Forgets where objects are: another scene is shown.
    void forget() {
        anchors_.clear();
        dragged_.clear();
    }

private:
    struct Handle {
        std::string kind, key; ///< as in edits
        std::string label;
        glm::dvec3 place{0}; ///< in world space
        glm::dvec3 value{0}; ///< that the edit replaces
        glm::dmat3 value_from_world{1};
    };
    std::vector<Handle> find(const View& view);
    void add_objects(const View& view, std::vector<Handle>& handles);

    std::map<std::uint32_t, glm::dvec3> anchors_; ///< middles of objects in their nodes' space
    std::string dragged_;                         ///< kind and key
    bool begins_ = false;
};

} // namespace argand::window
