#include "device/memory_ledger.hpp"

#include "base/error.hpp"

#include <algorithm>

namespace argand {

void MemoryLedger::allocated(const std::string& name, std::uint64_t bytes) {
    for (MemoryUse* use : {&by_name[name], &total}) {
        use->current += bytes;
        use->peak = std::max(use->peak, use->current);
    }
}

void MemoryLedger::freed(const std::string& name, std::uint64_t bytes) {
    by_name[name].current -= bytes;
    total.current -= bytes;
}

void check_allocation(const DeviceInfo& info, const MemoryLedger& ledger, const std::string& name,
                      std::uint64_t bytes) {
    if (bytes > info.limits.storage_range) {
        fail("allocating '{}': {} bytes exceed the {} bytes that a kernel can address on '{}'; use "
             "fewer photons, a "
             "smaller picture or another device",
             name, bytes, info.limits.storage_range, info.name);
    }
    check_memory(info, ledger, name, bytes);
}

void check_memory(const DeviceInfo& info, const MemoryLedger& ledger, const std::string& name,
                  std::uint64_t bytes) {
    if (ledger.total.current + bytes > info.limits.memory) {
        fail("allocating '{}': {} bytes more than the {} in use exceed the {} bytes of memory of "
             "'{}'; use fewer "
             "photons, a smaller picture or another device",
             name, bytes, ledger.total.current, info.limits.memory, info.name);
    }
}

void fail_out_of_memory(const MemoryLedger& ledger, const std::string& name, std::uint64_t bytes) {
    constexpr double mebibyte = 1 << 20;
    fail("allocating {:.1f} MiB for '{}': the device is out of memory ({:.1f} MiB in use); use "
         "fewer photons, a "
         "smaller picture or another device",
         static_cast<double>(bytes) / mebibyte, name,
         static_cast<double>(ledger.total.current) / mebibyte);
}

} // namespace argand
