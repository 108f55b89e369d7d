#include "compile.hpp"

#include "base/error.hpp"
#include "includer.hpp"

#include <glslang/Public/ResourceLimits.h>
#include <glslang/SPIRV/GlslangToSpv.h>

#include <regex>
#include <sstream>

namespace argand::shader_compile {
namespace {

struct Process {
    Process() { glslang::InitializeProcess(); }
    ~Process() { glslang::FinalizeProcess(); }
    Process(const Process&) = delete;
    Process& operator=(const Process&) = delete;
};

struct Messages {
    std::string error; ///< the first one: messages after a syntax error are noise
    std::string warnings;
};

std::string trimmed(const std::string& text) {
    const std::size_t first = text.find_first_not_of(" \t\r");
    return first == std::string::npos
               ? ""
               : text.substr(first, text.find_last_not_of(" \t\r") + 1 - first);
}

/// glslang's log in the form that editors understand: "ERROR: FILE:LINE: ..." becomes
/// "FILE:LINE: error: ...".
Messages messages(const std::string& log, const std::string& kernel) {
    static const std::regex located(R"((ERROR|WARNING): (.+?):(\d+): (.*))");
    static const std::regex unlocated(R"((ERROR|WARNING): (.*))");
    static const std::regex include(R"('#include' : (.*) for header name: (.*))");
    static const std::regex unnamed(R"('' : +(.*))");
    Messages result;
    std::istringstream lines(log);
    for (std::string line; std::getline(lines, line);) {
        std::smatch part;
        std::string place = kernel + ":1";
        std::string text;
        if (std::regex_match(line, part, located)) {
            place = part[2].str() + ":" + part[3].str();
            text = part[4];
        } else if (std::regex_match(line, part, unlocated)) {
            text = part[2];
        } else {
            continue;
        }
        text = trimmed(std::regex_replace(text, include, "cannot include $2: $1"));
        text = std::regex_replace(text, unnamed, "$1");
        if (part[1] == "WARNING") {
            result.warnings += fmt::format("{}: warning: {}\n", place, text);
        } else if (result.error.empty()) {
            result.error = fmt::format("{}: error: {}", place, text);
        }
    }
    return result;
}

EShLanguage stage_of(const std::string& path) {
    const std::filesystem::path extension = std::filesystem::path(path).extension();
    return extension == ".vert"   ? EShLangVertex
           : extension == ".frag" ? EShLangFragment
                                  : EShLangCompute;
}

[[noreturn]] void fail_with(const Messages& said, const std::string& kernel) {
    if (said.error.empty()) {
        fail("{}:1: error: glslang refuses it without a reason", kernel);
    }
    throw Error(said.error);
}

} // namespace

Compiled compile(const std::string& kernel, const std::vector<std::string>& include_directories,
                 const std::string& macro) {
    const std::string path = std::filesystem::path(kernel).lexically_normal().string();
    return compile_text(path, read_text(path), include_directories, macro);
}

Compiled compile_text(const std::string& path, const std::string& text,
                      const std::vector<std::string>& include_directories,
                      const std::string& macro) {
    const Process process;
    Compiled result;
    result.sources.push_back({path, text});
    if (!line_of(without_comments(text), {"#version", "460"})) {
        fail("{}:1: error: a kernel begins with #version 460", path);
    }

    const EShLanguage stage = stage_of(path);
    glslang::TShader shader(stage);
    const char* const string = text.data();
    const int length = static_cast<int>(text.size());
    const char* const name = path.c_str();
    shader.setStringsWithLengthsAndNames(&string, &length, &name, 1);
    const std::string preamble =
        fmt::format("#extension GL_GOOGLE_include_directive : require\n{}",
                    macro.empty() ? "" : fmt::format("#define {}\n", macro));
    shader.setPreamble(preamble.c_str());
    shader.setEnvInput(glslang::EShSourceGlsl, stage, glslang::EShClientVulkan, 100);
    shader.setEnvClient(glslang::EShClientVulkan, glslang::EShTargetVulkan_1_2);
    shader.setEnvTarget(glslang::EShTargetSpv, glslang::EShTargetSpv_1_5);

    const auto rules = static_cast<EShMessages>(EShMsgSpvRules | EShMsgVulkanRules);
    Includer includer(include_directories, result.sources);
    const bool parsed = shader.parse(GetDefaultResources(), 460, false, rules, includer);
    const Messages said = messages(shader.getInfoLog(), path);
    if (!parsed) {
        fail_with(said, path);
    }
    glslang::TProgram program;
    program.addShader(&shader);
    if (!program.link(rules)) {
        fail_with(messages(program.getInfoLog(), path), path);
    }

    glslang::SpvOptions options;
    options.disableOptimizer = true;
    spv::SpvBuildLogger logger;
    glslang::GlslangToSpv(*program.getIntermediate(stage), result.spirv, &logger, &options);
    result.warnings = said.warnings;
    return result;
}

} // namespace argand::shader_compile
