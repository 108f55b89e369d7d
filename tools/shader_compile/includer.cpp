#include "includer.hpp"

#include "base/error.hpp"

#include <algorithm>

namespace argand::shader_compile {
namespace fs = std::filesystem;
namespace {

using Result = glslang::TShader::Includer::IncludeResult;

/// glslang reports a result without a name as an error, with the data as its text.
Result* owning_result(const std::string& name, std::string text) {
    auto* owned = new std::string(std::move(text));
    return new Result(name, owned->data(), owned->size(), owned);
}

} // namespace

Result* Includer::includeLocal(const char* header, const char* includer, std::size_t depth) {
    // The depth counts from 1 and includes this file: whatever is deeper has been closed.
    open_.resize(std::min(open_.size(), depth - 1));
    const fs::path beside = (fs::path(includer).parent_path() / header).lexically_normal();
    return fs::is_regular_file(beside) ? found(beside.string()) : nullptr;
}

Result* Includer::includeSystem(const char* header, const char*, std::size_t depth) {
    open_.resize(std::min(open_.size(), depth - 1));
    for (const std::string& directory : directories_) {
        const fs::path path = (fs::path(directory) / header).lexically_normal();
        if (fs::is_regular_file(path)) {
            return found(path.string());
        }
    }
    return owning_result(
        "", fmt::format("cannot find it beside the including file or in {}", fmt::join(directories_, ", ")));
}

Result* Includer::found(const std::string& path) {
    if (path == sources_.front().path || std::find(open_.begin(), open_.end(), path) != open_.end()) {
        return owning_result(
            "", fmt::format("it includes itself, by way of {}", open_.empty() ? path : open_.back()));
    }
    std::string text;
    try {
        text = read_file(path);
    } catch (const Error& error) {
        return owning_result("", error.what());
    }
    open_.push_back(path);
    const bool known =
        std::any_of(sources_.begin(), sources_.end(), [&](const Source& s) { return s.path == path; });
    if (!known) {
        sources_.push_back({path, text});
    }
    return owning_result(path, std::move(text));
}

void Includer::releaseInclude(Result* result) {
    if (result != nullptr) {
        delete static_cast<std::string*>(result->userData);
        delete result;
    }
}

} // namespace argand::shader_compile
