#include "emit.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <set>

namespace argand::shader_compile {
namespace {

using Out = std::back_insert_iterator<std::string>;

std::string_view type_name(Access access) {
    return access == Access::read ? "Read" : access == Access::write ? "Write" : "ReadWrite";
}

std::string_view enumerator(Access access) {
    return access == Access::read ? "read" : access == Access::write ? "write" : "read_write";
}

std::size_t longest_name(const Reflection& interface) {
    std::size_t longest = 0;
    for (const Binding& binding : interface.bindings) {
        longest = std::max(longest, binding.name.size());
    }
    return longest;
}

void emit_checks(Out out, const Record& record) {
    fmt::format_to(out, "static_assert(sizeof({}) == {}, \"{} has another size on the GPU\");\n",
                   record.name, record.size, record.name);
    for (const Member& member : record.members) {
        fmt::format_to(
            out,
            "static_assert(offsetof({0}, {1}) == {2}, \"{0}::{1} lies elsewhere on the GPU\");\n",
            record.name, member.name, member.offset);
        if (member.array_stride != 0) {
            fmt::format_to(
                out,
                "static_assert(sizeof(std::declval<{0}>().{1}[0]) == {2}, \"elements of {0}::{1} "
                "lie elsewhere "
                "on the GPU\");\n",
                record.name, member.name, member.array_stride);
        }
    }
}

void emit_words(Out out, const Spirv& spirv) {
    for (std::size_t i = 0; i < spirv.size(); ++i) {
        fmt::format_to(out, "{}0x{:08x},", i % 8 == 0 ? "\n    " : " ", spirv[i]);
    }
}

/// Spaces would separate, `#` and `$` mean something.
std::string escaped(const std::string& path) {
    std::string result;
    for (const char c : path) {
        if (c == ' ' || c == '#') {
            result += '\\';
        } else if (c == '$') {
            result += '$';
        }
        result += c;
    }
    return result;
}

} // namespace

std::string emit_header(const Kernel& kernel) {
    const Reflection& interface = kernel.interface;
    const bool has_limits =
        std::any_of(interface.constants.begin(), interface.constants.end(), [](const Constant& c) {
            return c.value.find("numeric_limits") != std::string::npos;
        });
    std::string text;
    const Out out(text);
    fmt::format_to(
        out,
        "// Written by shader_compile from {}.\n#pragma once\n\n#include \"device/kernel.hpp\"\n",
        kernel.path);
    if (interface.push) {
        fmt::format_to(out, "#include \"{}\"\n", interface.push->header);
    }
    fmt::format_to(out, "{}\nnamespace argand::kernels {{\n\n/// {}\nstruct {} {{\n",
                   has_limits ? "\n#include <limits>\n" : "", kernel.path, kernel.name);
    const std::size_t width = longest_name(interface) + 1;
    for (std::size_t i = 0; i < interface.bindings.size(); ++i) {
        const Binding& binding = interface.bindings[i];
        fmt::format_to(out, "    {:9} {:{}} ///< binding {}\n", type_name(binding.access),
                       binding.name + ";", width, i);
    }
    if (interface.push) {
        fmt::format_to(out, "    {0} {1} = missing_push_constants<{0}>();\n", interface.push->name,
                       interface.push_name);
    }
    if (!interface.constants.empty()) {
        fmt::format_to(out, "    struct Constants {{\n");
        for (const Constant& constant : interface.constants) {
            fmt::format_to(out, "        {} {} = {};\n", constant.type, constant.name,
                           constant.value);
        }
        fmt::format_to(out, "    }} constants = {{}};\n");
    }
    fmt::format_to(
        out, "\n    static const KernelInfo info;\n    KernelArguments arguments() const;\n}};\n\n"
             "}} // namespace argand::kernels\n");
    return text;
}

std::string emit_source(const Kernel& kernel) {
    const Reflection& interface = kernel.interface;
    std::string text;
    const Out out(text);
    fmt::format_to(out, "// Written by shader_compile from {}.\n#include \"kernels/{}.hpp\"\n\n",
                   kernel.path, kernel.name);
    std::set<std::string> headers;
    for (const Record& record : interface.records) {
        headers.insert(record.header);
    }
    for (const std::string& header : headers) {
        fmt::format_to(out, "#include \"{}\"\n", header);
    }
    fmt::format_to(out,
                   "{}#include <cstddef>\n#include <utility>\n\nnamespace argand::kernels "
                   "{{\nnamespace {{\n\n",
                   headers.empty() ? "" : "\n");
    if (interface.push) {
        emit_checks(out, *interface.push);
    }
    for (const Record& record : interface.records) {
        emit_checks(out, record);
    }
    // The names differ between kernels, so that the sources of several make one translation unit.
    fmt::format_to(out, "\nconstexpr std::uint32_t {}_spirv[] = {{", kernel.name);
    emit_words(out, kernel.spirv);
    fmt::format_to(out, "\n}};\n");
    if (!interface.bindings.empty()) {
        fmt::format_to(out, "constexpr KernelBinding {}_bindings[] = {{\n", kernel.name);
        for (std::size_t i = 0; i < interface.bindings.size(); ++i) {
            fmt::format_to(out, "    {{\"{}\", {}, Access::{}, {}, \"{}\"}},\n",
                           interface.bindings[i].name, i, enumerator(interface.bindings[i].access),
                           interface.bindings[i].texels, interface.bindings[i].words);
        }
        fmt::format_to(out, "}};\n");
    }
    if (!interface.constants.empty()) {
        fmt::format_to(out, "constexpr KernelConstant {}_constants[] = {{\n", kernel.name);
        for (const Constant& constant : interface.constants) {
            fmt::format_to(out, "    {{\"{}\", {}}},\n", constant.name, constant.id);
        }
        fmt::format_to(out, "}};\n");
    }
    fmt::format_to(
        out,
        "\n}} // namespace\n\n{8}constinit const KernelInfo {0}::info{{\n"
        "    .name = \"{0}\",\n    .spirv = {0}_spirv,\n    .bindings = {1},\n    .constants = "
        "{2},\n"
        "    .push_bytes = {3},\n    .local_size = {{{4}, {5}, {6}}},\n    .uses_subgroups = "
        "{7},\n{9}}};\n\n",
        kernel.name, interface.bindings.empty() ? "{}" : kernel.name + "_bindings",
        interface.constants.empty() ? "{}" : kernel.name + "_constants",
        interface.push ? interface.push->size : 0, interface.local_size[0], interface.local_size[1],
        interface.local_size[2], interface.uses_subgroups,
        kernel.twin.empty()
            ? ""
            : fmt::format(
                  "RunOnHost twin_{0};\n#if ARGAND_CUDA\nLaunchOnCuda cuda_{0};\n#endif\n\n",
                  kernel.twin),
        kernel.twin.empty()
            ? ""
            : fmt::format("    .host = twin_{0},\n#if ARGAND_CUDA\n    .cuda = cuda_{0},\n#endif\n",
                          kernel.twin));
    fmt::format_to(out, "KernelArguments {}::arguments() const {{\n    KernelArguments result;\n",
                   kernel.name);
    for (const Binding& binding : interface.bindings) {
        fmt::format_to(out, "    result.add({});\n", binding.name);
    }
    if (interface.push) {
        fmt::format_to(out, "    result.set_push({});\n", interface.push_name);
    }
    for (const Constant& constant : interface.constants) {
        fmt::format_to(out, "    result.add_constant(constants.{});\n", constant.name);
    }
    fmt::format_to(out, "    return result;\n}}\n\n}} // namespace argand::kernels\n");
    return text;
}

std::string emit_depfile(const std::vector<std::string>& outputs,
                         const std::vector<std::string>& inputs) {
    std::string text;
    for (const std::string& output : outputs) {
        text += (text.empty() ? "" : " ") + escaped(output);
    }
    text += ":";
    for (const std::string& input : inputs) {
        text += " \\\n  " + escaped(input);
    }
    return text + "\n";
}

} // namespace argand::shader_compile
