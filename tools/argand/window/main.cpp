#include "../command_line.hpp"
#include "device/vulkan/instance.hpp"
#include "run_window.hpp"

#include <vector>

/// `argand view` with a window: a program of its own, so that `argand` needs no display's library.
int main(int argc, char** argv) {
    argand::vulkan::want_surfaces();
    std::vector<const char*> arguments(argv, argv + argc);
    arguments.insert(arguments.begin() + (argc > 0 ? 1 : 0), "view");
    return argand::run_command_line(static_cast<int>(arguments.size()), arguments.data(),
                                    argand::builtin_methods(), argand::window::run_window);
}
