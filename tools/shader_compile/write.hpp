#pragma once

#include <filesystem>
#include <string_view>

namespace argand::shader_compile {

/// Writes a file whole or not at all: beside its place, then renamed. A file that already has this text is
/// left alone, so that what depends on it is not built again. Throws Error.
void write_file(const std::filesystem::path& path, std::string_view text);

} // namespace argand::shader_compile
