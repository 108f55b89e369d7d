#pragma once

#include <string_view>
#include <volk.h>

namespace argand::vulkan {

/// Throws an Error that says in words what the driver reported, unless the call succeeded.
void check(VkResult result, std::string_view doing);

} // namespace argand::vulkan
