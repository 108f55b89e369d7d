#pragma once

#include <string>
#include <vector>

namespace argand {

/// Messages of the API's validation since the process started, including those about closed
/// devices. Validation is on in debug builds or with ARGAND_VALIDATION=1.
std::vector<std::string> all_validation_messages();

} // namespace argand
