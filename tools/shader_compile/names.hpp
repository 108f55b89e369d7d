#pragma once

#include <string_view>

namespace argand::shader_compile {

/// Whether C++ takes it as a name: letters, digits and underscores, not a keyword.
bool is_cpp_name(std::string_view name);

} // namespace argand::shader_compile
