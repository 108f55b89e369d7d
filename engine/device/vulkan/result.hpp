#pragma once

#include <string_view>
#include <volk.h>

namespace argand::vulkan {

/// Throws an Error that explains the driver's result code, unless the call succeeded.
void check(VkResult result, std::string_view doing);

} // namespace argand::vulkan
