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
    std::string errors;
    std::string warnings;
};

/// glslang's log in the form that editors understand: "ERROR: FILE:LINE: ..." becomes "FILE:LINE: error:
/// ...".
Messages messages(const std::string& log, const std::string& kernel) {
    static const std::regex located(R"((ERROR|WARNING): (.+?):(\d+): (.*))");
    static const std::regex unlocated(R"((ERROR|WARNING): (.*))");
    static const std::regex count(R"(ERROR: \d+ compilation errors\..*)");
    Messages result;
    std::istringstream lines(log);
    for (std::string line; std::getline(lines, line);) {
        std::smatch part;
        if (std::regex_match(line, count)) {
            continue;
        }
        std::string shown;
        if (std::regex_match(line, part, located)) {
            shown = fmt::format("{}:{}: {}: {}\n", part[2].str(), part[3].str(),
                                part[1] == "ERROR" ? "error" : "warning", part[4].str());
        } else if (std::regex_match(line, part, unlocated)) {
            shown = fmt::format("{}:1: {}: {}\n", kernel, part[1] == "ERROR" ? "error" : "warning",
                                part[2].str());
        } else {
            continue;
        }
        (part[1] == "ERROR" ? result.errors : result.warnings) += shown;
    }
    return result;
}

[[noreturn]] void fail_with(std::string errors, const std::string& kernel) {
    if (errors.empty()) {
        fail("{}:1: error: glslang refuses it without a reason", kernel);
    }
    errors.pop_back(); // the last newline
    throw Error(errors);
}

} // namespace

Compiled compile(const std::string& path, const std::vector<std::string>& include_directories) {
    const Process process;
    Compiled result;
    result.sources.push_back({path, read_file(path)});
    const std::string text = result.sources.front().text;

    glslang::TShader shader(EShLangCompute);
    const char* const string = text.data();
    const int length = static_cast<int>(text.size());
    const char* const name = path.c_str();
    shader.setStringsWithLengthsAndNames(&string, &length, &name, 1);
    shader.setPreamble("#extension GL_GOOGLE_include_directive : require\n");
    shader.setEnvInput(glslang::EShSourceGlsl, EShLangCompute, glslang::EShClientVulkan, 100);
    shader.setEnvClient(glslang::EShClientVulkan, glslang::EShTargetVulkan_1_2);
    shader.setEnvTarget(glslang::EShTargetSpv, glslang::EShTargetSpv_1_5);

    const auto rules = static_cast<EShMessages>(EShMsgSpvRules | EShMsgVulkanRules);
    Includer includer(include_directories, result.sources);
    const bool parsed = shader.parse(GetDefaultResources(), 460, false, rules, includer);
    Messages said = messages(shader.getInfoLog(), path);
    if (!parsed) {
        fail_with(said.errors, path);
    }
    glslang::TProgram program;
    program.addShader(&shader);
    if (!program.link(rules)) {
        fail_with(messages(program.getInfoLog(), path).errors, path);
    }

    glslang::SpvOptions options;
    options.disableOptimizer = true;
    spv::SpvBuildLogger logger;
    glslang::GlslangToSpv(*program.getIntermediate(EShLangCompute), result.spirv, &logger, &options);
    result.warnings = said.warnings;
    return result;
}

} // namespace argand::shader_compile
