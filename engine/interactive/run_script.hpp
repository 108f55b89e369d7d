#pragma once

#include "interactive/script.hpp"
#include "interactive/view.hpp"

#include <functional>

namespace argand {

/// What the caller does for a script.
struct ScriptCalls {
    /// Writes the last frame's picture to a file.
    std::function<void(View& view, const std::string& file)> screenshot;
    /// Told of each frame, and of what went wrong with the changes before it; empty: nothing.
    std::function<void(const ViewFrame& frame, const std::string& error)> on_frame;
    /// Whether to stop before the next frame.
    std::function<bool()> stops;
};

/// Runs a script. Changes that are refused do not end it. Throws Error after the frame where an
/// expectation is not met, or where a change is refused whose error is not expected.
void run_script(View& view, const Script& script, const ScriptCalls& calls);

} // namespace argand
