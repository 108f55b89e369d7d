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

/// The C++ struct of a group's bindings or constants: SceneBindings, SceneConstants of "scene".
std::string group_type(const std::string& group, std::string_view kind) {
    std::string name;
    bool start = true;
    for (const char c : group) {
        if (c != '_') {
            name += start ? static_cast<char>(std::toupper(static_cast<unsigned char>(c))) : c;
        }
        start = c == '_';
    }
    return name.append(kind);
}

/// The names of the groups among bindings and constants.
std::set<std::string> groups_of(const Reflection& interface) {
    std::set<std::string> groups;
    for (const Binding& binding : interface.bindings) {
        groups.insert(binding.group);
    }
    for (const Constant& constant : interface.constants) {
        groups.insert(constant.group);
    }
    groups.erase("");
    return groups;
}

/// How the kernel's struct names a binding or a constant that may be a group's.
template <class T> std::string member_of(const T& item) {
    return item.group.empty() ? item.name : item.group + "." + item.name;
}

std::ptrdiff_t count_of_group(const Reflection& interface, const std::string& group) {
    return std::count_if(interface.bindings.begin(), interface.bindings.end(),
                         [&](const Binding& binding) { return binding.group == group; });
}

struct Declaration {
    std::string type, name, comment;
};

/// A line each, names and comments aligned.
void emit_declarations(Out out, const std::vector<Declaration>& declarations) {
    std::size_t type_width = 9;
    std::size_t name_width = 0;
    for (const Declaration& declaration : declarations) {
        type_width = std::max(type_width, declaration.type.size());
        name_width = std::max(name_width, declaration.name.size() + 1);
    }
    for (const Declaration& declaration : declarations) {
        fmt::format_to(out, "    {:{}} {:{}} ///< {}\n", declaration.type, type_width,
                       declaration.name + ";", name_width, declaration.comment);
    }
}

/// The kernel's buffers, those of a group as one member.
std::vector<Declaration> binding_members(const Reflection& interface) {
    std::vector<Declaration> members;
    std::set<std::string> groups;
    for (std::size_t i = 0; i < interface.bindings.size(); ++i) {
        const Binding& binding = interface.bindings[i];
        if (binding.group.empty()) {
            members.push_back({std::string(type_name(binding.access)), binding.name,
                               fmt::format("binding {}", i)});
        } else if (groups.insert(binding.group).second) {
            members.push_back({group_type(binding.group, "Bindings"), binding.group,
                               fmt::format("bindings {} to {}", i,
                                           static_cast<std::ptrdiff_t>(i) +
                                               count_of_group(interface, binding.group) - 1)});
        }
    }
    return members;
}

void emit_constants(Out out, const Reflection& interface) {
    fmt::format_to(out, "    struct Constants {{\n");
    std::set<std::string> groups;
    for (const Constant& constant : interface.constants) {
        if (constant.group.empty()) {
            fmt::format_to(out, "        {} {} = {};\n", constant.type, constant.name,
                           constant.value);
        } else if (groups.insert(constant.group).second) {
            fmt::format_to(out, "        {} {} = {{}};\n", group_type(constant.group, "Constants"),
                           constant.group);
        }
    }
    fmt::format_to(out, "    }} constants = {{}};\n");
}

bool needs_limits(const Reflection& interface) {
    return std::any_of(interface.constants.begin(), interface.constants.end(),
                       [](const Constant& constant) {
                           return constant.value.find("numeric_limits") != std::string::npos;
                       });
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

void emit_bindings(Out out, const Kernel& kernel) {
    const std::vector<Binding>& bindings = kernel.interface.bindings;
    fmt::format_to(out, "constexpr KernelBinding {}_bindings[] = {{\n", kernel.name);
    for (std::size_t i = 0; i < bindings.size(); ++i) {
        const Binding& binding = bindings[i];
        fmt::format_to(out, "    {{.name = \"{}\", .binding = {}, .access = Access::{}",
                       binding.name, i, enumerator(binding.access));
        if (binding.texels) {
            fmt::format_to(out, ", .texels = true");
        }
        fmt::format_to(out, ", .words = \"{}\"", binding.words);
        if (!binding.unordered_stride.empty()) {
            fmt::format_to(out, ", .unordered = {{.head = {}, .stride = {}}}",
                           binding.unordered_head, binding.unordered_stride);
        }
        if (binding.incidental) {
            fmt::format_to(out, ", .incidental = true");
        }
        if (binding.refers_to >= 0) {
            fmt::format_to(out, ", .refers_to = {}", binding.refers_to);
        }
        fmt::format_to(out, "}},\n");
    }
    fmt::format_to(out, "}};\n");
}

/// A group has the same members in all kernels, whatever macros they define before they include it.
void emit_group_checks(Out out, const Reflection& interface) {
    for (const std::string& group : groups_of(interface)) {
        const auto count = count_of_group(interface, group);
        fmt::format_to(out,
                       "static_assert(sizeof({0}) == {1} * sizeof(BufferView), \"{2}_bindings.glsl "
                       "declares other buffers here\");\n",
                       group_type(group, "Bindings"), count, group);
    }
}

/// An array of words. The names differ between kernels, so that the sources of several make one
/// translation unit.
void emit_spirv(Out out, const std::string& name, const Spirv& spirv) {
    fmt::format_to(out, "\nconstexpr std::uint32_t {}_spirv[] = {{", name);
    emit_words(out, spirv);
    fmt::format_to(out, "\n}};\n");
}

std::string_view info_type(const Kernel& kernel) {
    return kernel.fragment ? "RasterInfo" : "KernelInfo";
}

void emit_interface(Out out, const Kernel& kernel) {
    const Reflection& interface = kernel.interface;
    fmt::format_to(out, "    .bindings = {},\n",
                   interface.bindings.empty() ? "{}" : kernel.name + "_bindings");
    fmt::format_to(out, "    .constants = {},\n",
                   interface.constants.empty() ? "{}" : kernel.name + "_constants");
    fmt::format_to(out, "    .push_bytes = {},\n", interface.push ? interface.push->size : 0);
}

void emit_raster_info(Out out, const Kernel& program) {
    fmt::format_to(out,
                   "constinit const RasterInfo {0}::info{{\n    .name = \"{0}\",\n"
                   "    .vertex = {0}_spirv,\n    .fragment = {0}_fragment_spirv,\n",
                   program.name);
    emit_interface(out, program);
    fmt::format_to(out, "    .words = {},\n}};\n\n", program.interface.result_words);
}

void declare_twin(Out out, const std::string& twin) {
    fmt::format_to(out, "RunOnHost twin_{0};\n#if ARGAND_CUDA\nLaunchOnCuda cuda_{0};\n#endif\n\n",
                   twin);
}

/// The last members of a KernelInfo or LeanModule.
void emit_twin_pointers(Out out, const std::string& twin) {
    fmt::format_to(out, "    .host = twin_{0},\n#if ARGAND_CUDA\n    .cuda = cuda_{0},\n#endif\n",
                   twin);
}

void emit_lean(Out out, const Kernel& kernel) {
    const std::string& name = kernel.name;
    for (std::size_t i = 0; i < kernel.lean.size(); ++i) {
        emit_spirv(out, fmt::format("{}_lean{}", name, i), kernel.lean[i].spirv);
        fmt::format_to(out, "constexpr LeanModule::Limit {}_lean{}_limits[] = {{\n", name, i);
        for (const Lean::Limit& limit : kernel.lean[i].limits) {
            fmt::format_to(out, "    {{{}, {}}},\n", limit.constant, limit.bits);
        }
        fmt::format_to(out, "}};\n");
    }
    if (!kernel.lean.empty()) {
        fmt::format_to(out, "constexpr LeanModule {}_lean[] = {{\n", name);
        for (std::size_t i = 0; i < kernel.lean.size(); ++i) {
            fmt::format_to(out, "    {{.spirv = {0}_lean{1}_spirv, .limits = {0}_lean{1}_limits,\n",
                           name, i);
            if (kernel.lean[i].has_twin) {
                emit_twin_pointers(out, kernel.twin + "_plain");
            }
            fmt::format_to(out, "    }},\n");
        }
        fmt::format_to(out, "}};\n");
    }
}

void emit_info(Out out, const Kernel& kernel) {
    const Reflection& interface = kernel.interface;
    const std::string& name = kernel.name;
    const bool has_twin = !kernel.twin.empty();
    if (has_twin) {
        declare_twin(out, kernel.twin);
    }
    fmt::format_to(out, "constinit const KernelInfo {0}::info{{\n    .name = \"{0}\",\n", name);
    fmt::format_to(out, "    .stage = \"{}\",\n", has_twin ? kernel.twin : name);
    fmt::format_to(out, "    .spirv = {}_spirv,\n", name);
    if (!kernel.lean.empty()) {
        fmt::format_to(out, "    .lean = {}_lean,\n", name);
    }
    emit_interface(out, kernel);
    fmt::format_to(out, "    .local_size = {{{}, {}, {}}},\n", interface.local_size[0],
                   interface.local_size[1], interface.local_size[2]);
    fmt::format_to(out, "    .uses_subgroups = {},\n", interface.uses_subgroups);
    if (has_twin) {
        emit_twin_pointers(out, kernel.twin);
    }
    fmt::format_to(out, "}};\n\n");
}

/// A path as make reads it: a space separates paths, and `#` and `$` have a meaning.
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
    std::string text;
    const Out out(text);
    fmt::format_to(
        out, "// Written by shader_compile from {}.\n#pragma once\n\n#include \"device/{}.hpp\"\n",
        kernel.path, kernel.fragment ? "raster" : "kernel");
    for (const std::string& group : groups_of(interface)) {
        fmt::format_to(out, "#include \"kernels/{}_bindings.hpp\"\n", group);
    }
    if (interface.push) {
        fmt::format_to(out, "#include \"{}\"\n", interface.push->header);
    }
    fmt::format_to(out, "{}\nnamespace argand::kernels {{\n\n/// {}\nstruct {} {{\n",
                   needs_limits(interface) ? "\n#include <limits>\n" : "", kernel.path,
                   kernel.name);
    emit_declarations(out, binding_members(interface));
    if (interface.push) {
        fmt::format_to(out, "    {0} {1} = missing_push_constants<{0}>();\n", interface.push->name,
                       interface.push_name);
    }
    if (!interface.constants.empty()) {
        emit_constants(out, interface);
    }
    fmt::format_to(out,
                   "\n    static const {} info;\n    KernelArguments arguments() const;\n}};\n\n"
                   "}} // namespace argand::kernels\n",
                   info_type(kernel));
    return text;
}

std::string emit_group(const Kernel& group) {
    std::string text;
    const Out out(text);
    fmt::format_to(
        out,
        "// Written by shader_compile from {0}.\n#pragma once\n\n#include "
        "\"device/kernel.hpp\"\n{1}\n"
        "namespace argand::kernels {{\n\n/// The buffers that {0} declares.\nstruct {2} {{\n",
        group.path, needs_limits(group.interface) ? "\n#include <limits>\n" : "",
        group_type(group.name, "Bindings"));
    std::vector<Declaration> members;
    for (const Binding& binding : group.interface.bindings) {
        members.push_back({std::string(type_name(binding.access)), binding.name,
                           fmt::format("binding {}", members.size())});
    }
    emit_declarations(out, members);
    fmt::format_to(out, "}};\n\n");
    if (!group.interface.constants.empty()) {
        fmt::format_to(out, "/// Its specialization constants.\nstruct {} {{\n",
                       group_type(group.name, "Constants"));
        for (const Constant& constant : group.interface.constants) {
            fmt::format_to(out, "    {} {} = {};\n", constant.type, constant.name, constant.value);
        }
        fmt::format_to(out, "}};\n\n");
    }
    fmt::format_to(out, "}} // namespace argand::kernels\n");
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
    headers.insert(interface.constant_headers.begin(), interface.constant_headers.end());
    for (const std::string& header : headers) {
        fmt::format_to(out, "#include \"{}\"\n", header);
    }
    fmt::format_to(out,
                   "{}#include <cstddef>\n#include <utility>\n\nnamespace argand::kernels "
                   "{{\n\n",
                   headers.empty() ? "" : "\n");
    if (plain_twin(kernel) != nullptr) {
        declare_twin(out, kernel.twin + "_plain");
    }
    fmt::format_to(out, "namespace {{\n\n");
    if (interface.push) {
        emit_checks(out, *interface.push);
    }
    for (const Record& record : interface.records) {
        emit_checks(out, record);
    }
    emit_group_checks(out, interface);
    emit_spirv(out, kernel.name, kernel.spirv);
    emit_lean(out, kernel);
    if (kernel.fragment) {
        emit_spirv(out, kernel.name + "_fragment", *kernel.fragment);
    }
    if (!interface.bindings.empty()) {
        emit_bindings(out, kernel);
    }
    if (!interface.constants.empty()) {
        fmt::format_to(out, "constexpr KernelConstant {}_constants[] = {{\n", kernel.name);
        for (const Constant& constant : interface.constants) {
            fmt::format_to(out, "    {{\"{}\", {}}},\n", constant.name, constant.id);
        }
        fmt::format_to(out, "}};\n");
    }
    fmt::format_to(out, "\n}} // namespace\n\n");
    if (kernel.fragment) {
        emit_raster_info(out, kernel);
    } else {
        emit_info(out, kernel);
    }
    fmt::format_to(out, "KernelArguments {}::arguments() const {{\n    KernelArguments result;\n",
                   kernel.name);
    for (const Binding& binding : interface.bindings) {
        fmt::format_to(out, "    result.add({});\n", member_of(binding));
    }
    if (interface.push) {
        fmt::format_to(out, "    result.set_push({});\n", interface.push_name);
    }
    for (const Constant& constant : interface.constants) {
        fmt::format_to(out, "    result.add_constant(constants.{});\n", member_of(constant));
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
