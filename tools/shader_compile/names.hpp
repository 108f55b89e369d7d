#pragma once

#include <string_view>

namespace argand::shader_compile {

/// Whether C++ accepts it as a name: ASCII letters, digits and underscores, and no keyword.
bool is_cpp_name(std::string_view name);

} // namespace argand::shader_compile
