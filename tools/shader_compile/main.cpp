// shader_compile -I DIRECTORY... --out DIRECTORY --depfile FILE [--twin NAME [--write-twin]]
// KERNEL.comp
//
// Compiles a GLSL kernel to SPIR-V and writes its C++ binding: KERNEL.hpp and KERNEL.cpp. --twin
// names the kernel that other backends run instead; if that is the kernel itself, KERNEL.twin.h
// declares what its body uses. --write-twin also writes the twin, KERNEL.cu.
#include "base/error.hpp"
#include "compile.hpp"
#include "emit.hpp"
#include "names.hpp"
#include "optimise.hpp"
#include "write.hpp"

#include <algorithm>
#include <cstdio>

namespace argand::shader_compile {
namespace {

namespace fs = std::filesystem;

struct Options {
    std::vector<std::string> include_directories;
    std::string out;
    std::string depfile;
    std::string twin;
    bool write_twin = false;
    std::string kernel;
};

Options parse(const std::vector<std::string>& words) {
    Options options;
    for (std::size_t i = 0; i < words.size(); ++i) {
        const bool is_option = words[i] == "-I" || words[i] == "--out" || words[i] == "--depfile" ||
                               words[i] == "--twin";
        if (is_option && i + 1 == words.size()) {
            throw UsageError(fmt::format("shader_compile: {} needs a value", words[i]));
        }
        if (words[i] == "-I") {
            options.include_directories.push_back(words[++i]);
        } else if (words[i] == "--out") {
            options.out = words[++i];
        } else if (words[i] == "--depfile") {
            options.depfile = words[++i];
        } else if (words[i] == "--twin") {
            options.twin = words[++i];
        } else if (words[i] == "--write-twin") {
            options.write_twin = true;
        } else if (words[i].starts_with("-") || !options.kernel.empty()) {
            throw UsageError(fmt::format("shader_compile: unknown argument {}", words[i]));
        } else {
            options.kernel = words[i];
        }
    }
    if (options.kernel.empty() || options.out.empty() || options.depfile.empty()) {
        throw UsageError("usage: shader_compile -I DIRECTORY... --out DIRECTORY --depfile FILE "
                         "[--twin NAME [--write-twin]] KERNEL.comp");
    }
    return options;
}

std::string in(const std::string& directory, const std::string& file) {
    return (fs::path(directory) / file).string();
}

/// The build reads the depfile elsewhere than this program runs, so paths in it are absolute.
std::vector<std::string> absolute_paths(const Sources& sources) {
    std::vector<std::string> paths;
    for (const Source& source : sources) {
        paths.push_back(fs::absolute(source.path).string());
    }
    return paths;
}

/// Writes NAME_bindings.hpp. The group is compiled alone, as a kernel that does nothing.
void run_group(const Options& options) {
    const std::string path = fs::path(options.kernel).lexically_normal().string();
    const std::string name = group_of(path);
    const std::string text =
        fmt::format("#version 460\nlayout(local_size_x = 1) in;\n#include \"kernel.glsl\"\n"
                    "#include \"{}\"\nvoid main() {{}}\n",
                    fs::path(path).filename().string());
    Compiled compiled = compile_text(path + ".comp", text, options.include_directories);
    std::fputs(compiled.warnings.c_str(), stderr);
    const Kernel group{name, path, reflect(compiled, options.include_directories, true), {}, ""};

    compiled.sources.erase(compiled.sources.begin()); // no file holds it
    const std::string header = in(options.out, name + "_bindings.hpp");
    write_if_changed(options.depfile, emit_depfile({header}, absolute_paths(compiled.sources)));
    write_if_changed(header, emit_group(group));
}

/// The kernel's lean module, if it has one: if a macro changes the default of one of its constants,
/// and makes the kernel shorter.
std::optional<Lean> compile_lean(const Options& options, const Compiled& whole,
                                 const Kernel& kernel) {
    const bool has_one = std::any_of(whole.sources.begin(), whole.sources.end(), [](const auto& s) {
        return s.text.find(lean_macro) != std::string::npos;
    });
    if (!has_one) {
        return {};
    }
    const Compiled compiled = compile(options.kernel, options.include_directories, true);
    const Reflection lean = reflect(compiled, options.include_directories);
    for (std::size_t i = 0; i < lean.constants.size(); ++i) {
        if (lean.constants[i].value != kernel.interface.constants[i].value) {
            Lean result{optimise(compiled.spirv, options.kernel), i, lean.constants[i].value};
            validate(result.spirv, options.kernel);
            if (result.spirv.size() < kernel.spirv.size()) {
                return result;
            }
        }
    }
    return {};
}

void run(const Options& options) {
    const std::string name = fs::path(options.kernel).stem().string();
    if (!is_cpp_name(name)) {
        fail(
            "{}:1: error: the file's name becomes the name of a C++ struct, and '{}' cannot be one",
            options.kernel, name);
    }
    const Compiled compiled = compile(options.kernel, options.include_directories);
    std::fputs(compiled.warnings.c_str(), stderr);

    Kernel kernel{name, options.kernel, reflect(compiled, options.include_directories),
                  optimise(compiled.spirv, options.kernel), options.twin};
    validate(kernel.spirv, options.kernel);
    kernel.lean = compile_lean(options, compiled, kernel);

    const std::string header = in(options.out, name + ".hpp");
    const std::string source = in(options.out, name + ".cpp");
    std::vector<std::string> outputs{header, source};
    if (!options.twin.empty()) {
        const std::string body =
            twin_body(compiled.sources, options.include_directories, options.twin);
        if (options.twin == name) {
            outputs.push_back(in(options.out, name + ".twin.h"));
            write_if_changed(outputs.back(), emit_twin_header(kernel));
        }
        if (options.write_twin) {
            outputs.push_back(in(options.out, name + ".cu"));
            write_if_changed(outputs.back(), emit_twin_source(kernel, body));
        }
    }
    write_if_changed(options.depfile, emit_depfile(outputs, absolute_paths(compiled.sources)));
    write_if_changed(header, emit_header(kernel));
    write_if_changed(source, emit_source(kernel));
}

} // namespace
} // namespace argand::shader_compile

int main(int count, char** words) {
    try {
        using namespace argand::shader_compile;
        const Options options = parse({words + 1, words + count});
        if (group_of(options.kernel).empty()) {
            run(options);
        } else {
            run_group(options);
        }
        return 0;
    } catch (const argand::UsageError& error) {
        std::fprintf(stderr, "%s\n", error.what());
        return 2;
    } catch (const std::exception& error) {
        std::fprintf(stderr, "%s\n", error.what());
        return 1;
    }
}
