#pragma once

#include "device/kernel.hpp"

#include <cstdint>
#include <span>
#include <vector>

namespace argand {

/// Sorts the records that invocations appended in the order in which they happened to run, so that
/// the buffers of two devices can be compared. Other buffers stay as they are.
void put_in_order(UnorderedRecords records, std::span<std::uint32_t> words);

/// Whether `a` and `b` hold the same unordered records in any order; false of other buffers.
bool are_same_records(UnorderedRecords records, std::vector<std::uint32_t> a,
                      std::vector<std::uint32_t> b);

/// A buffer of indices and the buffer into which they point, see KernelBinding::refers_to.
struct IndexedWords {
    std::vector<std::uint32_t> indices, targets;
};

/// The word to which the index at `item` refers; UINT32_MAX if it points nowhere.
std::uint32_t referred_word(const IndexedWords& words, std::size_t item);

} // namespace argand
