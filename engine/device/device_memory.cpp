#include "device/device_memory.hpp"

#include "base/environment.hpp"

namespace argand {

PooledStorage::~PooledStorage() {
    if (const std::shared_ptr<DeviceMemory> owner = memory.lock()) {
        owner->ledger_.freed(name, padded_size(size));
        owner->pool_.put(std::move(block));
    }
}

std::shared_ptr<PooledStorage> DeviceMemory::allocate(const DeviceInfo& info, std::string name,
                                                      std::uint64_t bytes,
                                                      const BlockPool::Allocate& allocate,
                                                      std::uint32_t kind) {
    std::unique_ptr<MemoryBlock> block =
        pool_.get({bytes, kind, info.limits.storage_range, info.limits.memory}, allocate);
    if (!block) {
        fail_out_of_memory(ledger_, name, bytes);
    }
    auto storage = std::make_shared<PooledStorage>();
    storage->name = std::move(name);
    storage->size = bytes;
    storage->block = std::move(block);
    storage->memory = weak_from_this();
    ledger_.allocated(storage->name, padded_size(bytes));
    return storage;
}

bool poisons_memory() { return environment("ARGAND_POISON") == "1"; }

} // namespace argand
