#include "compare/unordered.hpp"
#include "kernels/query_cells.hpp"
#include "kernels/trace_any_texels.hpp"
#include "shared/accel_records.h"

#include <algorithm>
#include <gtest/gtest.h>

namespace argand {
namespace {

TEST(Unordered, RecordsBehindTheHeadAreSorted) {
    std::vector<std::uint32_t> words{9, 8, 3, 1, 2, 7, 2, 6, 5};
    put_in_order({.head = 2, .stride = 2}, words);
    EXPECT_EQ(words, (std::vector<std::uint32_t>{9, 8, 2, 6, 2, 7, 3, 1, 5}));
}

TEST(Unordered, OtherBuffersStayAsTheyAre) {
    std::vector<std::uint32_t> words{3, 2, 1};
    put_in_order({}, words);
    put_in_order({.head = 4, .stride = 1}, words);
    EXPECT_EQ(words, (std::vector<std::uint32_t>{3, 2, 1}));
}

TEST(Unordered, RecordsAreTheSameInAnyOrder) {
    const UnorderedRecords pairs{.head = 1, .stride = 2};
    EXPECT_TRUE(are_same_records(pairs, {9, 1, 2, 3, 4}, {9, 3, 4, 1, 2}));
    EXPECT_FALSE(are_same_records(pairs, {9, 1, 2, 3, 4}, {8, 3, 4, 1, 2}));
    EXPECT_FALSE(are_same_records(pairs, {9, 1, 2, 3, 4}, {9, 3, 2, 1, 4}));
    EXPECT_FALSE(are_same_records({}, {1, 2}, {1, 2})) << "the order of other records counts";
}

TEST(Unordered, IndicesReferToWordsOrNowhere) {
    const IndexedWords words{{1, 0, UINT32_MAX}, {7, 5}};
    EXPECT_EQ(referred_word(words, 0), 5u);
    EXPECT_EQ(referred_word(words, 1), 7u);
    EXPECT_EQ(referred_word(words, 2), UINT32_MAX);
}

const KernelBinding& binding(const KernelInfo& kernel, std::string_view name) {
    return *std::find_if(kernel.bindings.begin(), kernel.bindings.end(),
                         [&](const KernelBinding& b) { return b.name == name; });
}

TEST(Unordered, KernelsSayWhichOfTheirBuffersAre) {
    const UnorderedRecords suspended =
        binding(kernels::trace_any_texels::info, "suspended").unordered;
    EXPECT_EQ(suspended.head, suspended_head);
    EXPECT_EQ(suspended.stride, suspended_stride);
    const KernelInfo& cells = kernels::query_cells::info;
    EXPECT_TRUE(binding(cells, "table").incidental);
    EXPECT_EQ(binding(cells, "sources").refers_to,
              static_cast<int>(binding(cells, "owners").binding));
}

TEST(Stage, IsTheNameOfTheTwin) {
    EXPECT_STREQ(kernels::trace_any_texels::info.stage, "trace_any");
    EXPECT_STREQ(kernels::query_cells::info.stage, "query_cells");
}

} // namespace
} // namespace argand
