#include "command_line.hpp"

int main(int argc, char** argv) {
    return argand::run_command_line(argc, argv, argand::builtin_methods());
}
