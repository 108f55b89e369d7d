// shader_compile -I DIRECTORY... --out DIRECTORY --depfile FILE
// [--twin NAME [--write-twin [--plain-twin]]] KERNEL.comp | NAME.vert
//
// Compiles a GLSL kernel, or the raster program of NAME.vert and NAME.frag beside it, to SPIR-V and
// writes its C++ binding: KERNEL.hpp and KERNEL.cpp. --twin names the kernel that other backends
// run instead; if that is the kernel itself, KERNEL.twin.h declares what its body uses.
// --write-twin also writes the twin, KERNEL.cu, and --plain-twin that of the kernel's lean module
// for plain scenes, KERNEL.plain.cu.
#include "base/error.hpp"
#include "compile.hpp"
#include "emit.hpp"
#include "fix_constants.hpp"
#include "names.hpp"
#include "optimise.hpp"
#include "write.hpp"

#include <algorithm>
#include <cstdio>
#include <set>

namespace argand::shader_compile {
namespace {

namespace fs = std::filesystem;

struct Options {
    std::vector<std::string> include_directories;
    std::string out;
    std::string depfile;
    std::string twin;
    bool write_twin = false;
    bool plain_twin = false;
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
        } else if (words[i] == "--plain-twin") {
            options.plain_twin = true;
        } else if (words[i].starts_with("-") || !options.kernel.empty()) {
            throw UsageError(fmt::format("shader_compile: unknown argument {}", words[i]));
        } else {
            options.kernel = words[i];
        }
    }
    if (options.kernel.empty() || options.out.empty() || options.depfile.empty() ||
        (options.write_twin && options.twin.empty()) ||
        (options.plain_twin && !options.write_twin)) {
        throw UsageError("usage: shader_compile -I DIRECTORY... --out DIRECTORY --depfile FILE "
                         "[--twin NAME [--write-twin [--plain-twin]]] KERNEL.comp | NAME.vert");
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

/// Whether a constant has only a part of its default's bits: for a boolean one, whether it is
/// false.
bool has_part_of_bits(const Constant& part, const Constant& whole) {
    return part.value == "false" || (part.type == "std::uint32_t" &&
                                     (std::stoul(part.value) & ~std::stoul(whole.value)) == 0);
}

/// The kernel compiled with a macro that changes the defaults of some specialization constants to
/// the bits that remain.
Lean compile_with(const std::string& macro, const Options& options, const Kernel& kernel) {
    const Compiled compiled = compile(options.kernel, options.include_directories, macro);
    const std::vector<Constant> constants =
        reflect(compiled, options.include_directories).constants;
    Lean result{.macro = macro};
    std::set<std::uint32_t> fixed;
    for (std::size_t i = 0; i < constants.size(); ++i) {
        const Constant& whole = kernel.interface.constants[i];
        const std::string& bits = constants[i].value;
        if (bits == whole.value) {
            continue;
        }
        if (!has_part_of_bits(constants[i], whole)) {
            fail("{}:1: error: with {} the default of {} is {}, which is neither false nor a part "
                 "of the bits of {}",
                 options.kernel, macro, whole.name, bits, whole.value);
        }
        result.limits.push_back({i, bits});
        if (bits == "false") {
            fixed.insert(constants[i].id);
        }
    }
    if (!result.limits.empty()) {
        result.spirv = optimise(fix_constants(compiled.spirv, fixed), options.kernel);
        validate(result.spirv, options.kernel);
    }
    return result;
}

/// The kernel's lean modules: those of macros that its sources name, if they are much shorter.
std::vector<Lean> compile_lean(const Options& options, const Compiled& whole,
                               const Kernel& kernel) {
    std::vector<Lean> result;
    for (const std::string macro : lean_macros) {
        if (std::none_of(whole.sources.begin(), whole.sources.end(), [&](const Source& s) {
                return s.text.find(macro) != std::string::npos;
            })) {
            continue;
        }
        Lean lean = compile_with(macro, options, kernel);
        if (!lean.limits.empty()) {
            result.push_back(std::move(lean));
        }
    }
    // A module is worth its bytes in the program if it is an eighth shorter than the next one.
    std::size_t next = kernel.spirv.size();
    for (auto lean = result.end(); lean != result.begin();) {
        --lean;
        if (lean->spirv.size() < next / 8 * 7) {
            next = lean->spirv.size();
        } else {
            lean = result.erase(lean);
        }
    }
    return result;
}

/// Gives the kernel's module for plain scenes a twin. Throws Error if it has no such module.
void add_plain_twin(Kernel& kernel) {
    const auto found = std::ranges::find(kernel.lean, lean_macros[0], &Lean::macro);
    if (found == kernel.lean.end()) {
        fail("{}:1: error: its module for {} is missing or hardly shorter than the whole kernel; "
             "take it off PLAIN_TWINS",
             kernel.path, lean_macros[0]);
    }
    found->has_twin = true;
}

std::string name_of(const Options& options) {
    std::string name = fs::path(options.kernel).stem().string();
    if (!is_cpp_name(name)) {
        fail(
            "{}:1: error: the file's name becomes the name of a C++ struct, and '{}' cannot be one",
            options.kernel, name);
    }
    return name;
}

/// Both shaders of a raster program have the interface of its C++ struct, of which either may use
/// a part only.
void expect_same_interface(const Kernel& vertex, const Reflection& fragment,
                           const std::string& fragment_path) {
    const auto declares = [](const Reflection& interface) {
        std::string text = interface.push ? interface.push->name : "";
        for (const Binding& binding : interface.bindings) {
            text += "; " + binding.name + " " + binding.words;
        }
        for (const Constant& constant : interface.constants) {
            text += fmt::format("; {} {} {}", constant.id, constant.name, constant.value);
        }
        return text;
    };
    if (declares(vertex.interface) != declares(fragment)) {
        fail("{}:1: error: it declares other buffers or constants than {}; declare them in one "
             "file that both include",
             fragment_path, vertex.path);
    }
}

/// Writes the binding of a raster program, NAME.vert and NAME.frag.
void run_raster(const Options& options) {
    const std::string name = name_of(options);
    const std::string fragment_path = fs::path(options.kernel).replace_extension(".frag").string();
    const Compiled vertex = compile(options.kernel, options.include_directories);
    const Compiled fragment = compile(fragment_path, options.include_directories);
    std::fputs((vertex.warnings + fragment.warnings).c_str(), stderr);

    Kernel program{name,
                   options.kernel,
                   reflect(vertex, options.include_directories),
                   optimise(vertex.spirv, options.kernel),
                   {}};
    validate(program.spirv, options.kernel);
    const Reflection interface = reflect(fragment, options.include_directories);
    expect_same_interface(program, interface, fragment_path);
    program.interface.result_words = interface.result_words;
    program.fragment = optimise(fragment.spirv, fragment_path);
    validate(*program.fragment, fragment_path);

    const std::string header = in(options.out, name + ".hpp");
    const std::string source = in(options.out, name + ".cpp");
    std::vector<std::string> inputs = absolute_paths(vertex.sources);
    for (const std::string& path : absolute_paths(fragment.sources)) {
        inputs.push_back(path);
    }
    write_if_changed(options.depfile, emit_depfile({header, source}, inputs));
    write_if_changed(header, emit_header(program));
    write_if_changed(source, emit_source(program));
}

void run(const Options& options) {
    const std::string name = name_of(options);
    const Compiled compiled = compile(options.kernel, options.include_directories);
    std::fputs(compiled.warnings.c_str(), stderr);

    Kernel kernel{name, options.kernel, reflect(compiled, options.include_directories),
                  optimise(compiled.spirv, options.kernel), options.twin};
    validate(kernel.spirv, options.kernel);
    kernel.lean = compile_lean(options, compiled, kernel);
    if (options.plain_twin) {
        add_plain_twin(kernel);
    }

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
        if (options.plain_twin) {
            outputs.push_back(in(options.out, name + ".plain.cu"));
            write_if_changed(outputs.back(), emit_plain_twin_source(kernel, body));
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
        if (!group_of(options.kernel).empty()) {
            run_group(options);
        } else if (options.kernel.ends_with(".vert")) {
            run_raster(options);
        } else {
            run(options);
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
