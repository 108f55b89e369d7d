#include "sources.hpp"

#include "base/read_file.hpp"

#include <algorithm>
#include <cctype>
#include <fmt/format.h>

namespace argand::shader_compile {
namespace {

bool is_word(char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_'; }

bool is_blank(char c) { return std::isspace(static_cast<unsigned char>(c)) != 0; }

/// Whether the text has `word` at `at`, not as a part of a longer word.
bool stands_at(std::string_view text, std::size_t at, std::string_view word) {
    if (text.substr(at, word.size()) != word) {
        return false;
    }
    const std::size_t end = at + word.size();
    const bool open_left = at > 0 && is_word(text[at - 1]) && is_word(word.front());
    const bool open_right = end < text.size() && is_word(text[end]) && is_word(word.back());
    return !open_left && !open_right;
}

bool all_stand_at(std::string_view text, std::size_t at,
                  std::initializer_list<std::string_view> words) {
    for (const std::string_view word : words) {
        while (at < text.size() && is_blank(text[at])) {
            ++at;
        }
        if (!stands_at(text, at, word)) {
            return false;
        }
        at += word.size();
    }
    return true;
}

} // namespace

std::string shared_path(const Source& source, const std::vector<std::string>& include_directories) {
    for (const std::string& directory : include_directories) {
        std::string path =
            std::filesystem::path(source.path).lexically_relative(directory).generic_string();
        if (path.starts_with("shared/")) {
            return path;
        }
    }
    return "";
}

std::string read_text(const std::filesystem::path& path) {
    const std::vector<std::uint8_t> bytes = read_file(path);
    return {bytes.begin(), bytes.end()};
}

std::string without_comments(std::string_view text) {
    std::string result(text);
    enum { code, line_comment, block_comment } state = code;
    for (std::size_t i = 0; i < text.size(); ++i) {
        const std::string_view two = text.substr(i, 2);
        if (state == code && (two == "//" || two == "/*")) {
            state = two == "//" ? line_comment : block_comment;
            result[i] = result[i + 1] = ' ';
            ++i;
        } else if (state == block_comment && two == "*/") {
            state = code;
            result[i] = result[i + 1] = ' ';
            ++i;
        } else if (text[i] == '\n') {
            state = state == line_comment ? code : state;
        } else if (state != code) {
            result[i] = ' ';
        }
    }
    return result;
}

std::optional<int> line_of(std::string_view text, std::initializer_list<std::string_view> words) {
    const std::string_view first = *words.begin();
    for (std::size_t at = text.find(first); at != std::string_view::npos;
         at = text.find(first, at + 1)) {
        if (stands_at(text, at, first) && all_stand_at(text, at, words)) {
            return 1 + static_cast<int>(std::count(
                           text.begin(), text.begin() + static_cast<std::ptrdiff_t>(at), '\n'));
        }
    }
    return std::nullopt;
}

std::string error_at(const Sources& sources, std::initializer_list<std::string_view> words) {
    for (const Source& source : sources) {
        if (const std::optional<int> line = line_of(without_comments(source.text), words)) {
            return fmt::format("{}:{}: error: ", source.path, *line);
        }
    }
    return fmt::format("{}:1: error: ", sources.front().path);
}

} // namespace argand::shader_compile
