#pragma once

#include "methods/table.hpp"
#include "view_window.hpp"

namespace argand {

/// Runs `argand` with these arguments, the program's name first, and these methods. Returns the
/// exit status: 0, 1 for a failure, 2 for a wrong command line. Never throws. window: of
/// `argand view`.
int run_command_line(int argc, const char* const* argv, MethodTable methods,
                     ShowInWindow window = nullptr);

} // namespace argand
