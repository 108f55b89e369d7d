#pragma once

#include "interactive/script.hpp"
#include "interactive/view.hpp"
#include "picture_options.hpp"

#include <functional>
#include <optional>
#include <string>

namespace argand {

/// What a window is told of the view that it shows.
struct WindowStart {
    const PictureOptions& picture;
    std::optional<Script> script; ///< that runs in it, and then closes it
    /// The command that renders the picture at rest, whose edits are in a file of this name,
    /// as it is displayed.
    std::function<std::string(const View&, const std::string& edits, const PictureOptions&)>
        command;
    /// Told of each frame, and of what went wrong with the changes before it; empty: nothing.
    std::function<void(const ViewFrame& frame, const std::string& error)> on_frame;
};

/// Shows a view until the user closes the window, or its script ends. Null in `argand` itself,
/// which starts the program `argand-view` beside it instead.
using ShowInWindow = void (*)(View& view, const WindowStart& start);

} // namespace argand
