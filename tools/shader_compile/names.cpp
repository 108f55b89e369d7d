#include "names.hpp"

#include <algorithm>
#include <array>

namespace argand::shader_compile {
namespace {

// C++ keywords that GLSL allows as names.
constexpr std::array keywords{"alignas",     "alignof",      "and",
                              "and_eq",      "auto",         "bitand",
                              "bitor",       "catch",        "char",
                              "char16_t",    "char32_t",     "char8_t",
                              "co_await",    "co_return",    "co_yield",
                              "compl",       "concept",      "const_cast",
                              "consteval",   "constexpr",    "constinit",
                              "decltype",    "delete",       "dynamic_cast",
                              "explicit",    "export",       "friend",
                              "mutable",     "new",          "not",
                              "not_eq",      "nullptr",      "operator",
                              "or",          "or_eq",        "private",
                              "protected",   "register",     "reinterpret_cast",
                              "requires",    "signed",       "static_assert",
                              "static_cast", "thread_local", "throw",
                              "try",         "typeid",       "typename",
                              "virtual",     "wchar_t",      "xor",
                              "xor_eq",      "class",        "enum",
                              "extern",      "goto",         "inline",
                              "interface",   "long",         "namespace",
                              "public",      "short",        "sizeof",
                              "static",      "template",     "this",
                              "typedef",     "union",        "unsigned",
                              "using",       "volatile",     "asm"};

} // namespace

bool is_cpp_name(std::string_view name) {
    const auto is_letter = [](char c) {
        return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_';
    };
    const auto is_digit = [](char c) { return c >= '0' && c <= '9'; };
    return !name.empty() && is_letter(name.front()) &&
           std::all_of(name.begin(), name.end(),
                       [&](char c) { return is_letter(c) || is_digit(c); }) &&
           std::find(keywords.begin(), keywords.end(), name) == keywords.end();
}

} // namespace argand::shader_compile
