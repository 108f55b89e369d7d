#pragma once

#include <string>
#include <vector>

namespace argand {

/// UsageError if writing `target` would replace one of `others`, by whatever path each is named.
void check_overwrites_none(const std::string& target, const std::vector<std::string>& others);

} // namespace argand
