// shader_compile -I DIRECTORY... --out DIRECTORY --depfile FILE [--twin NAME [--write-twin]]
// KERNEL.comp
//
// Compiles a GLSL kernel to SPIR-V and writes its C++ binding: KERNEL.hpp and KERNEL.cpp. --twin
// names the kernel that other backends run instead; if that is the kernel itself, KERNEL.twin.h
// declares what its text uses. --write-twin also writes the twin, KERNEL.cu.
#include "base/error.hpp"
#include "compile.hpp"
#include "emit.hpp"
#include "names.hpp"
#include "optimise.hpp"
#include "write.hpp"

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

    const std::string header = (fs::path(options.out) / (name + ".hpp")).string();
    const std::string source = (fs::path(options.out) / (name + ".cpp")).string();
    std::vector<std::string> inputs;
    for (const Source& input : compiled.sources) {
        // The build runs elsewhere than this program.
        inputs.push_back(fs::absolute(input.path).string());
    }
    std::vector<std::string> outputs{header, source};
    if (!options.twin.empty()) {
        const std::string text =
            twin_text(compiled.sources, options.include_directories, options.twin);
        const std::string twin_header = (fs::path(options.out) / (name + ".twin.h")).string();
        const std::string twin_source = (fs::path(options.out) / (name + ".cu")).string();
        if (options.twin == name) {
            outputs.push_back(twin_header);
            write_if_changed(twin_header, emit_twin_header(kernel));
        }
        if (options.write_twin) {
            outputs.push_back(twin_source);
            write_if_changed(twin_source, emit_twin_source(kernel, text));
        }
    }
    write_if_changed(options.depfile, emit_depfile(outputs, inputs));
    write_if_changed(header, emit_header(kernel));
    write_if_changed(source, emit_source(kernel));
}

} // namespace
} // namespace argand::shader_compile

int main(int count, char** words) {
    try {
        argand::shader_compile::run(argand::shader_compile::parse({words + 1, words + count}));
        return 0;
    } catch (const argand::UsageError& error) {
        std::fprintf(stderr, "%s\n", error.what());
        return 2;
    } catch (const std::exception& error) {
        std::fprintf(stderr, "%s\n", error.what());
        return 1;
    }
}
