// Free blocks of memory: their sizes, who gets them, and when they are released.
#include "device/block_pool.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace argand {
namespace {

constexpr std::uint64_t mebibyte = 1 << 20;

class FreeBlocks : public ::testing::Test {
protected:
    struct CountedBlock final : MemoryBlock {
        std::uint64_t& count;
        explicit CountedBlock(std::uint64_t& live) : count(live) { ++count; }
        ~CountedBlock() override { --count; }
    };

    std::unique_ptr<MemoryBlock> get(const BlockPool::Request& request) {
        return pool_.get(request, [&](std::uint64_t bytes) -> std::unique_ptr<MemoryBlock> {
            if (live_ >= most_live_) {
                return nullptr;
            }
            auto block = std::make_unique<CountedBlock>(live_);
            block->bytes = bytes;
            return block;
        });
    }

    std::uint64_t live_ = 0;
    std::uint64_t most_live_ = UINT64_MAX; ///< then memory has run out
    BlockPool pool_;
};

TEST_F(FreeBlocks, HaveSizesThatAreAtMostASixteenthAboveTheRequest) {
    for (const std::uint64_t bytes : {0ull, 1ull, 15ull, 16ull, 17ull, 255ull, 257ull, 1'000ull,
                                      4'097ull, 1'000'003ull, (1ull << 32) + 1, (1ull << 40) - 1}) {
        const std::uint64_t size = block_size(bytes, UINT64_MAX);
        EXPECT_GE(size, std::max<std::uint64_t>(bytes, 16)) << bytes;
        EXPECT_EQ(size % 16, 0u) << bytes;
        EXPECT_LE(size, padded_size(bytes) + padded_size(bytes) / 16) << bytes;
        EXPECT_EQ(block_size(size, UINT64_MAX), size) << bytes;
    }
    EXPECT_EQ(block_size(mebibyte - 17, mebibyte), mebibyte);
    EXPECT_EQ(block_size(mebibyte + 1, mebibyte + 16), mebibyte + 16);
}

TEST_F(FreeBlocks, ServeRequestsOfTheirSize) {
    for (const std::uint64_t bytes : {0ull, 17ull, 333ull, 1'000'003ull, 1ull << 33}) {
        const std::uint64_t before = pool_.use().allocations;
        std::unique_ptr<MemoryBlock> block = get({bytes});
        const MemoryBlock* const first = block.get();
        EXPECT_GE(block->bytes, bytes);
        pool_.put(std::move(block));
        block = get({bytes});
        EXPECT_EQ(block.get(), first) << bytes;
        EXPECT_EQ(pool_.use().allocations, before + 1) << bytes;
        pool_.put(std::move(block));
    }
}

TEST_F(FreeBlocks, ServeNoSmallerNorLargerNorOtherRequest) {
    constexpr std::uint64_t all = 64 * 16'000; // the block is as large as a small share of it
    const std::uint64_t size = block_size(15'900, UINT64_MAX);
    EXPECT_EQ(size, 16'384u);
    const auto serves = [&](std::uint64_t bytes, std::uint32_t kind, std::uint64_t memory) {
        pool_ = BlockPool();
        pool_.put(get({15'900}));
        get({bytes, kind, UINT64_MAX, memory});
        return pool_.use().allocations == 1;
    };
    EXPECT_TRUE(serves(size, 0, UINT64_MAX));
    EXPECT_FALSE(serves(size + 1, 0, UINT64_MAX));
    EXPECT_FALSE(serves(size, 1, UINT64_MAX));
    EXPECT_TRUE(serves(size / 2, 0, UINT64_MAX));
    EXPECT_FALSE(serves(size / 2 - 16, 0, UINT64_MAX));
    EXPECT_FALSE(serves(size / 2, 0, all));
    EXPECT_TRUE(serves(size * 4 / 5 + 16, 0, all));
    EXPECT_FALSE(serves(size * 4 / 5 - 16, 0, all));
    EXPECT_TRUE(serves(size / 2, 0, all + 64 * 400));
}

TEST_F(FreeBlocks, ServeTheBestFit) {
    std::vector<std::unique_ptr<MemoryBlock>> blocks;
    for (const std::uint64_t bytes : {1'200, 1'000, 1'100}) {
        blocks.push_back(get({bytes * 16}));
    }
    const MemoryBlock* const best = blocks[1].get();
    for (std::unique_ptr<MemoryBlock>& block : blocks) {
        pool_.put(std::move(block));
    }
    EXPECT_EQ(get({990 * 16}).get(), best);
}

TEST_F(FreeBlocks, NeverHaveMoreBytesThanWereInUseAtOnce) {
    std::uint64_t most = 0;
    for (std::uint64_t i = 0; i < 100; ++i) {
        const std::uint64_t bytes = mebibyte * (100 + 37 * i % 100);
        std::unique_ptr<MemoryBlock> block = get({bytes});
        most = std::max(most, block->bytes);
        pool_.put(std::move(block));
        EXPECT_LE(pool_.use().free_bytes, most);
    }
    pool_.put(get({1'000 * mebibyte}));
    EXPECT_EQ(live_, 1u);
    for (std::uint64_t i = 0; i < 2 * BlockPool::most_free; ++i) {
        pool_.put(get({16, static_cast<std::uint32_t>(i)}));
    }
    EXPECT_EQ(live_, BlockPool::most_free);
}

TEST_F(FreeBlocks, AreReleasedIfNobodyNeedsThem) {
    const std::unique_ptr<MemoryBlock> kept = get({64});
    pool_.put(get({mebibyte}));
    for (std::uint64_t i = 0; i < BlockPool::patience; ++i) {
        pool_.put(get({64}));
        ASSERT_EQ(live_, 3u) << i;
    }
    pool_.put(get({64}));
    EXPECT_EQ(live_, 2u);
    EXPECT_EQ(pool_.use().bytes, 128u);
}

TEST_F(FreeBlocks, AreReleasedBeforeMemoryRunsOut) {
    std::vector<std::unique_ptr<MemoryBlock>> blocks;
    blocks.push_back(get({16}));
    blocks.push_back(get({3'000}));
    for (std::unique_ptr<MemoryBlock>& block : blocks) {
        pool_.put(std::move(block));
    }
    most_live_ = 2;
    blocks[0] = get({500}); // the allocation fails at first
    ASSERT_NE(blocks[0], nullptr);
    EXPECT_EQ(live_, 1u);
    EXPECT_EQ(pool_.use().bytes, blocks[0]->bytes);
    EXPECT_EQ(pool_.use().free_bytes, 0u);
    blocks[1] = get({500});
    EXPECT_EQ(get({16}), nullptr);
    EXPECT_EQ(pool_.use().bytes, blocks[0]->bytes + blocks[1]->bytes);
}

TEST_F(FreeBlocks, AndTheirRoundingGiveWayToTheLimit) {
    std::vector<std::unique_ptr<MemoryBlock>> blocks;
    pool_.put(get({3 * mebibyte}));
    const BlockPool::Request request{2 * mebibyte + 16, 0, UINT64_MAX, 4 * mebibyte};
    blocks.push_back(get(request));
    EXPECT_EQ(live_, 1u);
    EXPECT_GT(blocks[0]->bytes, request.bytes);
    blocks.push_back(get({4 * mebibyte - blocks[0]->bytes - 16, 0, UINT64_MAX, 4 * mebibyte}));
    EXPECT_LE(pool_.use().bytes, 4 * mebibyte);
}

} // namespace
} // namespace argand
