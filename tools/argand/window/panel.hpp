#pragma once

#include "../picture_options.hpp"
#include "base/error.hpp"
#include "interactive/view.hpp"

#include <array>
#include <deque>
#include <nlohmann/json.hpp>
#include <string>

namespace argand::window {

/// What the panel knows beside the view.
struct PanelState {
    ViewFrame frame;                 ///< the last one
    std::string message;             ///< what went wrong last; empty: nothing
    PictureOptions picture;          ///< exposure and tone
    bool plays = false;              ///< the animations run
    std::deque<nlohmann::json> undo; ///< edits before each change
};

/// What the user asked for that is not the view's.
struct PanelWishes {
    bool screenshot = false, save_edits = false, copy_command = false;
    bool changes_display = false;     ///< exposure or tone
    std::array<float, 4> rectangle{}; ///< of the panel: left, top, right, bottom
};

/// Draws the panel, and applies what is changed in it to the view.
PanelWishes draw_panel(View& view, PanelState& state);

/// Remembers the edits as they are, so that undo() returns to them.
void remember(const View& view, PanelState& state);
/// Returns to the edits before the last change.
void undo(View& view, PanelState& state);

/// Calls `change`; what it throws becomes the message. Returns whether it threw nothing.
template <class Change> bool attempt(PanelState& state, const Change& change) {
    try {
        change();
        return true;
    } catch (const DeviceFault&) {
        throw;
    } catch (const Error& error) {
        state.message = error.what();
        return false;
    }
}

} // namespace argand::window
