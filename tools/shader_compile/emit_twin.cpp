#include "base/error.hpp"
#include "emit.hpp"

#include <algorithm>
#include <iterator>

namespace argand::shader_compile {

const Lean* plain_twin(const Kernel& kernel) {
    const auto found = std::ranges::find(kernel.lean, true, &Lean::has_twin);
    return found == kernel.lean.end() ? nullptr : &*found;
}

namespace {

/// Whether a twin of this module lacks this constant: it is false there.
bool lacks(const Lean* module, std::size_t constant) {
    return module != nullptr && std::ranges::any_of(module->limits, [&](const Lean::Limit& limit) {
               return limit.constant == constant && limit.bits == "false";
           });
}

} // namespace

std::string emit_twin_header(const Kernel& kernel) {
    const Reflection& interface = kernel.interface;
    const Lean* plain = plain_twin(kernel);
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
        out,
        "\nnamespace argand::ARGAND_TWINS {{\n\n/// What {} declares.\nstruct {}_arguments {{\n",
        kernel.path, kernel.name);
    for (const Binding& binding : interface.bindings) {
        fmt::format_to(out, "    {}{}* {};\n", binding.access == Access::read ? "const " : "",
                       binding.type, binding.name);
    }
    if (interface.push) {
        fmt::format_to(out, "    {} {};\n", interface.push->name, interface.push_name);
    }
    for (std::size_t i = 0; i < interface.constants.size(); ++i) {
        const Constant& constant = interface.constants[i];
        if (lacks(plain, i)) {
            fmt::format_to(out,
                           "#ifdef {2}\n    static constexpr {0} {1} = false;\n#else\n"
                           "    {0} {1};\n#endif\n",
                           constant.type, constant.name, plain->macro);
        } else {
            fmt::format_to(out, "    {} {};\n", constant.type, constant.name);
        }
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
        const std::string get =
            fmt::format("    from.get_constant({}, to.{});\n", i, interface.constants[i].name);
        text += lacks(plain, i) ? fmt::format("#ifndef {}\n{}#endif\n", plain->macro, get) : get;
    }
    fmt::format_to(out, "    return to;\n}}\n\n}} // namespace argand::ARGAND_TWINS\n");
    return text;
}

namespace {

std::string twin_source(const Kernel& kernel, const std::string& define, const std::string& body,
                        const std::string& name) {
    return fmt::format("// Written by shader_compile from {1}.\n"
                       "{2}"
                       "#include \"cuda/kernel.h\"\n"
                       "#include \"kernels/{0}.twin.h\"\n"
                       "\n"
                       "namespace argand::ARGAND_TWINS {{\n"
                       "struct {0} : {0}_arguments {{\n"
                       "    uint thread_index = 0;\n"
                       "#include \"{3}\"\n"
                       "}};\n"
                       "}} // namespace argand::ARGAND_TWINS\n"
                       "\n"
                       "ARGAND_TWIN_AS({0}, {4})\n",
                       kernel.name, kernel.path, define, body, name);
}

} // namespace

std::string emit_twin_source(const Kernel& kernel, const std::string& body) {
    return twin_source(kernel, "", body, kernel.name);
}

std::string emit_plain_twin_source(const Kernel& kernel, const std::string& body) {
    return twin_source(kernel, fmt::format("#define {}\n", plain_twin(kernel)->macro), body,
                       kernel.name + "_plain");
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
