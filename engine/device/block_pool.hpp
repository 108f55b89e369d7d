#pragma once

#include "device/device.hpp"

#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

namespace argand {

/// Memory of a device, released by the destructor; backends derive from it.
struct MemoryBlock {
    std::uint64_t bytes = 0;
    std::uint32_t kind = 0; ///< blocks take the place only of those of their kind

    MemoryBlock() = default;
    MemoryBlock(const MemoryBlock&) = delete;
    MemoryBlock& operator=(const MemoryBlock&) = delete;
    virtual ~MemoryBlock() = default;
};

/// `bytes` as kernels need them: they read four 32-bit words at a time, even from buffers without
/// elements.
std::uint64_t padded_size(std::uint64_t bytes);

/// Size of the block for a request of `bytes` bytes: padded_size() rounded up to one of 16 sizes in
/// each power of two, at most a sixteenth more, unless that exceeds `most`.
std::uint64_t block_size(std::uint64_t bytes, std::uint64_t most);

/// Blocks that are no longer in use, for later requests of about their size. Free blocks are at
/// most `most_free`, and never have more bytes than were in use at once. The block that was free
/// for the longest time is released first, and so is one that none of the last `patience` requests
/// took.
class BlockPool {
public:
    static constexpr std::uint64_t patience = 4096;
    static constexpr std::size_t most_free = 1024; // Vulkan's drivers allow 4096 allocations

    /// A request that the pool may serve with any block that is at most a quarter larger, or twice
    /// as large if that is a small share of the device's memory.
    struct Request {
        std::uint64_t bytes = 0;
        std::uint32_t kind = 0;
        std::uint64_t most_in_block = UINT64_MAX; ///< bytes that kernels can address
        std::uint64_t most_in_all = UINT64_MAX;   ///< bytes of memory that the device has
    };
    /// Allocates a block of this many bytes; null if memory has run out.
    using Allocate = std::function<std::unique_ptr<MemoryBlock>(std::uint64_t bytes)>;

    /// A free block, or a new one. If memory has run out, all free blocks are released and a block
    /// without rounding is tried. Null if that fails, too.
    std::unique_ptr<MemoryBlock> get(const Request& request, const Allocate& allocate);
    /// Takes back a block from get().
    void put(std::unique_ptr<MemoryBlock> block);
    /// Releases all free blocks.
    void trim();

    const BlockUse& use() const { return use_; }

private:
    static constexpr std::uint64_t small_share = 64;

    struct Free {
        std::unique_ptr<MemoryBlock> block;
        std::uint64_t since; ///< requests before it became free
    };

    std::unique_ptr<MemoryBlock> take(const Request& request);
    void release_oldest();

    BlockUse use_;
    std::vector<Free> free_; ///< oldest first
    std::uint64_t requests_ = 0;
    std::uint64_t most_in_use_ = 0; ///< bytes
};

} // namespace argand
