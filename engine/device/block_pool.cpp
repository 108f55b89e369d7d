#include "device/block_pool.hpp"

#include <algorithm>
#include <bit>

namespace argand {

std::uint64_t padded_size(std::uint64_t bytes) {
    constexpr std::uint64_t unit = 16;
    return std::max((bytes + unit - 1) / unit * unit, unit);
}

std::uint64_t block_size(std::uint64_t bytes, std::uint64_t most) {
    constexpr std::uint64_t sizes = 16; // in each power of two
    const std::uint64_t padded = padded_size(bytes);
    const std::uint64_t step = std::max<std::uint64_t>(std::bit_floor(padded) / sizes, 1);
    const std::uint64_t rounded = padded_size((padded + step - 1) / step * step);
    return rounded <= most ? rounded : padded;
}

std::unique_ptr<MemoryBlock> BlockPool::get(const Request& request, const Allocate& allocate) {
    ++requests_;
    while (!free_.empty() && requests_ - free_.front().since > patience) {
        release_oldest();
    }
    std::unique_ptr<MemoryBlock> block = take(request);
    if (!block) {
        std::uint64_t bytes = block_size(request.bytes, request.most_in_block);
        if (use_.bytes + bytes > request.most_in_all) {
            trim();
        }
        if (use_.bytes + bytes > request.most_in_all) {
            bytes = padded_size(request.bytes);
        }
        block = allocate(bytes);
        if (!block) {
            trim();
            block = allocate(padded_size(request.bytes));
        }
        if (!block) {
            return nullptr;
        }
        block->kind = request.kind;
        ++use_.allocations;
        use_.bytes += block->bytes;
    }
    most_in_use_ = std::max(most_in_use_, use_.bytes - use_.free_bytes);
    return block;
}

std::unique_ptr<MemoryBlock> BlockPool::take(const Request& request) {
    const std::uint64_t least = padded_size(request.bytes);
    const std::uint64_t most =
        std::max(least + least / 4, std::min(2 * least, request.most_in_all / small_share));
    auto best = free_.end();
    for (auto i = free_.begin(); i != free_.end(); ++i) {
        const MemoryBlock& block = *i->block;
        // Of equal blocks the newest, which may still be in a cache.
        if (block.kind == request.kind && block.bytes >= least && block.bytes <= most &&
            (best == free_.end() || block.bytes <= best->block->bytes)) {
            best = i;
        }
    }
    if (best == free_.end()) {
        return nullptr;
    }
    std::unique_ptr<MemoryBlock> block = std::move(best->block);
    free_.erase(best);
    use_.free_bytes -= block->bytes;
    return block;
}

void BlockPool::put(std::unique_ptr<MemoryBlock> block) {
    use_.free_bytes += block->bytes;
    free_.push_back({std::move(block), requests_});
    while (free_.size() > most_free || use_.free_bytes > most_in_use_) {
        release_oldest();
    }
}

void BlockPool::release_oldest() {
    const std::uint64_t bytes = free_.front().block->bytes;
    free_.erase(free_.begin());
    use_.bytes -= bytes;
    use_.free_bytes -= bytes;
}

void BlockPool::trim() {
    while (!free_.empty()) {
        release_oldest();
    }
}

} // namespace argand
