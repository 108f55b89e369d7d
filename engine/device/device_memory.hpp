#pragma once

#include "device/block_pool.hpp"
#include "device/memory_ledger.hpp"

#include <memory>
#include <string>

namespace argand {

class DeviceMemory;

/// A backend's buffer: a block that goes back to the pool.
struct PooledStorage final : BufferStorage {
    std::unique_ptr<MemoryBlock> block;
    std::weak_ptr<DeviceMemory> memory; ///< expired if the buffer has outlived its device

    ~PooledStorage() override;
};

/// The memory of a device: what is in use, by name, and free blocks.
class DeviceMemory : public std::enable_shared_from_this<DeviceMemory> {
public:
    /// A buffer of a free block or of one that `allocate` allocates. Throws Error if memory has run
    /// out; check_allocation() is the caller's.
    std::shared_ptr<PooledStorage> allocate(const DeviceInfo& info, std::string name,
                                            std::uint64_t bytes,
                                            const BlockPool::Allocate& allocate,
                                            std::uint32_t kind = 0);

    /// Memory outside blocks is entered by its owner.
    MemoryLedger& ledger() { return ledger_; }
    const MemoryLedger& ledger() const { return ledger_; }
    const BlockUse& blocks() const { return pool_.use(); }

private:
    friend struct PooledStorage;

    MemoryLedger ledger_;
    BlockPool pool_;
};

/// The block of a buffer that DeviceMemory allocated.
template <class Block> Block& block_of(const Buffer& buffer) {
    return static_cast<Block&>(*static_cast<PooledStorage&>(*buffer.storage()).block);
}

/// Whether ARGAND_POISON=1: backends then fill all memory that they allocate with undefined_word,
/// so that tests find reads of what was never written.
bool poisons_memory();

} // namespace argand
