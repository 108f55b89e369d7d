#pragma once

#include <filesystem>
#include <string_view>

namespace argand::shader_compile {

/// As argand::write_atomically, but a file that already has this text is left alone, so that what
/// depends on it is not built again.
void write_if_changed(const std::filesystem::path& path, std::string_view text);

} // namespace argand::shader_compile
