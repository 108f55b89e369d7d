#include "compare/unordered.hpp"

#include <algorithm>

namespace argand {

void put_in_order(UnorderedRecords layout, std::span<std::uint32_t> words) {
    if (layout.stride == 0 || words.size() < layout.head) {
        return;
    }
    const std::size_t count = (words.size() - layout.head) / layout.stride;
    std::vector<std::vector<std::uint32_t>> records(count);
    for (std::size_t i = 0; i < count; ++i) {
        const auto record = words.subspan(layout.head + i * layout.stride, layout.stride);
        records[i].assign(record.begin(), record.end());
    }
    std::sort(records.begin(), records.end());
    auto to = words.begin() + static_cast<std::ptrdiff_t>(layout.head);
    for (const std::vector<std::uint32_t>& record : records) {
        to = std::copy(record.begin(), record.end(), to);
    }
}

bool are_same_records(UnorderedRecords records, std::vector<std::uint32_t> a,
                      std::vector<std::uint32_t> b) {
    if (records.stride == 0) {
        return false;
    }
    put_in_order(records, a);
    put_in_order(records, b);
    return a == b;
}

std::uint32_t referred_word(const IndexedWords& words, std::size_t item) {
    const std::uint32_t index = words.indices[item];
    return index < words.targets.size() ? words.targets[index] : UINT32_MAX;
}

} // namespace argand
