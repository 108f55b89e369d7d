#include "emit.hpp"

#include <fmt/format.h>

#include <iterator>

namespace argand::shader_compile {

std::string emit_twin(const Kernel& kernel) {
    const Reflection& interface = kernel.interface;
    std::string text;
    const auto out = std::back_inserter(text);
    fmt::format_to(
        out,
        "// Written by shader_compile from {}.\n#pragma once\n\n#include \"device/twin.hpp\"\n",
        kernel.path);
    for (const std::string& header : interface.headers) {
        fmt::format_to(out, "#include \"{}\"\n", header);
    }
    fmt::format_to(
        out, "\nnamespace argand::twins {{\n\n/// What {} declares.\nstruct {}_arguments {{\n",
        kernel.path, kernel.name);
    for (const Binding& binding : interface.bindings) {
        fmt::format_to(out, "    {}{}* {};\n", binding.access == Access::read ? "const " : "",
                       binding.type, binding.name);
    }
    if (interface.push) {
        fmt::format_to(out, "    {} {};\n", interface.push->name, interface.push_name);
    }
    for (const Constant& constant : interface.constants) {
        fmt::format_to(out, "    {} {};\n", constant.type, constant.name);
    }
    fmt::format_to(out,
                   "}};\n\ninline {0}_arguments arguments_of(const TwinArguments& from, "
                   "{0}_arguments to = {{}}) {{\n",
                   kernel.name);
    for (std::size_t i = 0; i < interface.bindings.size(); ++i) {
        const Binding& binding = interface.bindings[i];
        fmt::format_to(out, "    to.{} = static_cast<{}*>(from.buffers[{}]);\n", binding.name,
                       binding.type, i);
    }
    if (interface.push) {
        fmt::format_to(out, "    from.get_push(to.{});\n", interface.push_name);
    }
    for (std::size_t i = 0; i < interface.constants.size(); ++i) {
        fmt::format_to(out, "    from.get_constant({}, to.{});\n", i, interface.constants[i].name);
    }
    fmt::format_to(out, "    return to;\n}}\n\n}} // namespace argand::twins\n");
    return text;
}

} // namespace argand::shader_compile
