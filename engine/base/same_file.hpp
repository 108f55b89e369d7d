#pragma once

#include <filesystem>

namespace argand {

/// Whether both paths lead to one file, which need not exist: after links, `.` and `..` in the part
/// of them that does.
bool is_same_file(const std::filesystem::path& a, const std::filesystem::path& b);

} // namespace argand
