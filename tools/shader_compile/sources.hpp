#pragma once

#include <filesystem>
#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace argand::shader_compile {

/// One file that took part in a compilation. `path` is what messages show.
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

/// The text with comments replaced by blanks, lines kept.
std::string without_comments(std::string_view text);

/// The line (from 1) on which these words and symbols first stand in this order, only blanks
/// between them.
std::optional<int> line_of(std::string_view text, std::initializer_list<std::string_view> words);

/// "file:line: error: " of the first source in which the words stand; of the kernel's first line if
/// in none.
std::string error_at(const Sources& sources, std::initializer_list<std::string_view> words);

} // namespace argand::shader_compile
