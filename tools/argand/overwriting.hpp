#pragma once

#include <string>
#include <vector>

namespace argand {

/// Throws UsageError if writing `target` would replace one of the files `others`, however their
/// paths are spelled.
void check_overwrites_none(const std::string& target, const std::vector<std::string>& others);

} // namespace argand
