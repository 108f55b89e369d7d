#pragma once

#include <cstdint>
#include <span>
#include <string_view>

namespace argand {

/// Some stages leave records in the order in which invocations happened to come. Sorts them, so that two devices' can be
/// compared; records elsewhere are left alone.
void put_in_order(std::string_view stage, std::string_view buffer, std::span<std::uint32_t> words);

/// Whether a buffer's contents say nothing that later stages do not say again, independent of the order.
bool is_incidental(std::string_view stage, std::string_view buffer);

} // namespace argand
