#include "compare/unordered.hpp"

#include "shared/accel_records.h"
#include "shared/query_cell.h"
#include "shared/query_record.h"

#include <algorithm>
#include <vector>

namespace argand {

namespace {

struct Unordered {
    std::string_view stage, buffer;
    std::size_t head;   ///< words before the records
    std::size_t stride; ///< words of a record
};

constexpr Unordered unordered[] = {
    {"photon_footprints", "area_places", 0, 1},
    {"trace_closest", "suspended", suspended_head, suspended_stride},
    {"trace_any", "suspended", suspended_head, suspended_stride},
};

} // namespace

void put_in_order(std::string_view stage, std::string_view buffer, std::span<std::uint32_t> words) {
    for (const Unordered& u : unordered) {
        if (u.stage != stage || u.buffer != buffer || words.size() < u.head) {
            continue;
        }
        const std::size_t count = (words.size() - u.head) / u.stride;
        std::vector<std::vector<std::uint32_t>> records(count);
        for (std::size_t i = 0; i < count; ++i) {
            const auto first = words.begin() + static_cast<std::ptrdiff_t>(u.head + i * u.stride);
            records[i].assign(first, first + static_cast<std::ptrdiff_t>(u.stride));
        }
        std::sort(records.begin(), records.end());
        auto to = words.begin() + static_cast<std::ptrdiff_t>(u.head);
        for (const std::vector<std::uint32_t>& record : records) {
            to = std::copy(record.begin(), record.end(), to);
        }
    }
}

std::uint32_t owner_of(const CellTables& tables, std::size_t query) {
    const std::uint32_t entry = tables.sources[query];
    return entry < tables.owners.size() ? tables.owners[entry] : no_query;
}

bool is_incidental(std::string_view stage, std::string_view buffer) {
    // Which entry of the table a cell of queries gets; its owner is compared.
    const bool is_cell =
        stage == cells_stage && (buffer == "table" || buffer == "owners" || buffer == "sources");
    // Which of two children came first to their parent; the nodes are compared.
    return is_cell || (stage == "lbvh_fit" && buffer == "ends");
}

} // namespace argand
