#include "includer.hpp"

#include "base/error.hpp"

#include <algorithm>

namespace argand::shader_compile {
namespace fs = std::filesystem;
namespace {

using Result = glslang::TShader::Includer::IncludeResult;

/// glslang takes a result without a name for an error, and the text for its message.
Result* owning_result(const std::string& name, std::string text) {
    auto* owned = new std::string(std::move(text));
    return new Result(name, owned->data(), owned->size(), owned);
}

} // namespace

/// The path of the included file; empty if there is none.
std::string Includer::resolve(const std::string& header, const std::string& includer) const {
    std::vector<fs::path> places{fs::path(includer).parent_path()};
    places.insert(places.end(), directories_.begin(), directories_.end());
    for (const fs::path& place : places) {
        const fs::path path = (place / header).lexically_normal();
        std::error_code unreadable;
        if (fs::exists(path, unreadable)) {
            return path.string();
        }
    }
    return "";
}

Result* Includer::includeSystem(const char* header, const char* includer, std::size_t depth) {
    // The depth of this file, from 1: deeper files have been closed.
    open_.resize(std::min(open_.size(), depth - 1));
    const std::string path = resolve(header, includer);
    if (path.empty()) {
        return owning_result("", fmt::format("it is neither beside the including file nor in {}",
                                             fmt::join(directories_, ", ")));
    }
    if (path == sources_.front().path ||
        std::find(open_.begin(), open_.end(), path) != open_.end()) {
        return owning_result("",
                             open_.empty() || open_.back() == path
                                 ? "it includes itself"
                                 : fmt::format("it includes itself, by way of {}", open_.back()));
    }
    std::string text;
    try {
        text = read_text(path);
    } catch (const Error& error) {
        return owning_result("", error.what());
    }
    open_.push_back(path);
    const bool known = std::any_of(sources_.begin(), sources_.end(),
                                   [&](const Source& s) { return s.path == path; });
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
