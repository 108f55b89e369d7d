#pragma once

#include "sources.hpp"

#include <glslang/Public/ShaderLang.h>

namespace argand::shader_compile {

/// Resolves #include first beside the including file, then in the include directories, and records
/// every file in `sources`. A file that includes itself, directly or not, is an error.
class Includer : public glslang::TShader::Includer {
public:
    Includer(const std::vector<std::string>& directories, Sources& sources)
        : directories_(directories), sources_(sources) {}

    // glslang calls this for "..." too, for includeLocal finds nothing. Only messages from here
    // reach its log.
    IncludeResult* includeSystem(const char* header, const char* includer,
                                 std::size_t depth) override;
    void releaseInclude(IncludeResult* result) override;

private:
    std::string resolve(const std::string& header, const std::string& includer) const;

    const std::vector<std::string>& directories_;
    Sources& sources_;
    std::vector<std::string> open_; ///< the files being read, outermost first
};

} // namespace argand::shader_compile
