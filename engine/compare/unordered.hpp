#pragma once

#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

namespace argand {

/// Some stages leave records in the order in which invocations happened to come. Sorts them, so
/// that two devices' can be compared; records elsewhere are left alone.
void put_in_order(std::string_view stage, std::string_view buffer, std::span<std::uint32_t> words);

/// Whether a buffer's contents say nothing that later stages do not say again, independent of the
/// order.
bool is_incidental(std::string_view stage, std::string_view buffer);

/// Gives queries cells of a hash table; which entry a cell gets depends on who comes first.
inline constexpr std::string_view cells_stage = "query_cells";

/// What that stage wrote: the entry of each query's cell, and each entry's owner.
struct CellTables {
    std::vector<std::uint32_t> sources, owners;
};

/// The owner of a query's cell; no_query if it has none.
std::uint32_t owner_of(const CellTables& tables, std::size_t query);

} // namespace argand
