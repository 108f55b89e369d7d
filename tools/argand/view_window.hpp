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
    std::optional<Script> script;                    ///< that runs in it, and then closes it
    std::function<std::string(const View&)> command; ///< that renders the picture at rest
};

/// Shows a view until the user closes the window, or its script ends. Null in `argand` itself,
/// which starts the program `argand-view` beside it instead.
using ShowInWindow = void (*)(View& view, const WindowStart& start);

} // namespace argand
