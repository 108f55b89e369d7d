#pragma once

#include <string>
#include <vector>

namespace argand {

/// Messages of the API's validation since the process began, those about devices that are closed by
/// now, too (only if it is on: debug builds, or ARGAND_VALIDATION=1).
std::vector<std::string> all_validation_messages();

} // namespace argand
