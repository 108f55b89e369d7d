#pragma once

#include <filesystem>
#include <string_view>

namespace argand::shader_compile {

/// As argand::write_atomically, but leaves a file alone that already has this text, so that the
/// build does not compile its dependants again.
void write_if_changed(const std::filesystem::path& path, std::string_view text);

} // namespace argand::shader_compile
