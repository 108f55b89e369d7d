#pragma once

#include "device/device.hpp"

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace argand {

/// One measurement.
struct BenchRow {
    std::string name;
    std::uint64_t n = 0;  ///< items
    double seconds = 0;   ///< median of several runs
    double rate = 0;      ///< items per second
    std::string unit;     ///< of the items
    double bound = 0;     ///< items per second if only memory traffic mattered; 0: unknown
    std::string peer;     ///< library that does the same on the host; empty: none
    double peer_rate = 0; ///< items per second
};

/// Median time in seconds of the commands that `work` records, by the device's time stamps if it
/// has them, else by the clock. `prepare` is recorded before each run and not timed.
double median_device_seconds(Device& device, const std::function<void()>& prepare,
                             const std::function<void()>& work);

/// Median time in seconds of `work` on the host. `prepare` runs before each run and is not timed.
double median_host_seconds(const std::function<void()>& prepare, const std::function<void()>& work);

/// Bytes per second that the device reads and writes while copying a buffer that does not fit in
/// caches.
double copy_rate(Device& device);

/// Benchmarks reductions, scans, primitives of segments, compaction and sorts of 2^10 to 2^24
/// elements, up to the largest buffer of the device, against the standard library on one thread.
std::vector<BenchRow> bench_parallel(Device& device);

} // namespace argand
