#pragma once

#include "../view_window.hpp"

namespace argand::window {

/// Shows a view in a window until the user closes it, or its script ends. Throws Error if there is
/// no display, or nothing can draw on it.
void run_window(View& view, const WindowStart& start);

} // namespace argand::window
