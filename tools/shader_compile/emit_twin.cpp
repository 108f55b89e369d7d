#include "base/error.hpp"
#include "emit.hpp"

#include <iterator>

namespace argand::shader_compile {

std::string emit_twin_header(const Kernel& kernel) {
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

std::string emit_twin_source(const Kernel& kernel, const std::string& body) {
    return fmt::format("// Written by shader_compile from {1}.\n"
                       "#include \"cuda/kernel.h\"\n"
                       "#include \"kernels/{0}.twin.h\"\n"
                       "\n"
                       "namespace argand::twins {{\n"
                       "struct {0} : {0}_arguments {{\n"
                       "    uint thread_index = 0;\n"
                       "#include \"{2}\"\n"
                       "}};\n"
                       "}} // namespace argand::twins\n"
                       "\n"
                       "ARGAND_TWIN({0})\n",
                       kernel.name, kernel.path, body);
}

std::string twin_body(const Sources& sources, const std::vector<std::string>& include_directories,
                      const std::string& twin) {
    for (const Source& source : sources) {
        const std::string path = shared_path(source, include_directories);
        if (path.starts_with("shared/kernels/") && path.ends_with("/" + twin + ".h")) {
            return path;
        }
    }
    fail("{}:1: error: the kernel has no body that other backends can run; move its main() to "
         "shaders/shared/kernels/.../{}.h and include that",
         sources.front().path, twin);
}

} // namespace argand::shader_compile
