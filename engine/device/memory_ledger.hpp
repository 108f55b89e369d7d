#pragma once

#include "device/device.hpp"

#include <map>
#include <string>

namespace argand {

/// Bytes in use, by name of the allocation.
struct MemoryLedger {
    std::map<std::string, MemoryUse> by_name;
    MemoryUse total;

    void allocated(const std::string& name, std::uint64_t bytes);
    void freed(const std::string& name, std::uint64_t bytes);
};

/// Throws Error if a buffer of this size exceeds the memory that a kernel can address or that the
/// device has left.
void check_allocation(const DeviceInfo& info, const MemoryLedger& ledger, const std::string& name,
                      std::uint64_t bytes);

/// The same for memory that no kernel addresses.
void check_memory(const DeviceInfo& info, const MemoryLedger& ledger, const std::string& name,
                  std::uint64_t bytes);

/// Throws Error: an allocation failed although the device reported enough memory.
[[noreturn]] void fail_out_of_memory(const MemoryLedger& ledger, const std::string& name,
                                     std::uint64_t bytes);

} // namespace argand
