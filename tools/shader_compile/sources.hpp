#pragma once

#include <filesystem>
#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace argand::shader_compile {

/// A file that took part in a compilation. `path` is the path that messages show.
struct Source {
    std::string path;
    std::string text;
};

/// The kernel itself first, then every file it includes, each once.
using Sources = std::vector<Source>;

/// The path of a source under shared/ in one of the include directories, as C++ includes it
/// ("shared/..."); empty for other sources.
std::string shared_path(const Source& source, const std::vector<std::string>& include_directories);

/// As argand::read_file.
std::string read_text(const std::filesystem::path& path);

/// The text with its comments replaced by blanks; line numbers stay.
std::string without_comments(std::string_view text);

/// The line (from 1) of the first place where these words and symbols follow each other with only
/// blanks between them.
std::optional<int> line_of(std::string_view text, std::initializer_list<std::string_view> words);

/// "file:line: error: " for the first source that has these words, see line_of(); for the kernel's
/// first line if none has.
std::string error_at(const Sources& sources, std::initializer_list<std::string_view> words);

} // namespace argand::shader_compile
