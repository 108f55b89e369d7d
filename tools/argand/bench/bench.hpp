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
    double bound = 0;     ///< items per second if nothing but memory traffic counted; 0: not known
    std::string peer;     ///< who does the same on the host; empty: nobody
    double peer_rate = 0; ///< items per second
};

/// Median time in seconds of what `work` records, by the device's time stamps if it has them, else
/// by the clock. `prepare` is recorded before each run and not timed.
double median_device_seconds(Device& device, const std::function<void()>& prepare,
                             const std::function<void()>& work);

/// Median time in seconds of `work` on the host; `prepare` runs before each and is not timed.
double median_host_seconds(const std::function<void()>& prepare, const std::function<void()>& work);

double median(std::vector<double> values);

/// Bytes per second that the device reads and writes while it copies a buffer too large for caches.
double copy_rate(Device& device);

/// Reductions, scans, compaction and sorts of 2^10 to 2^24 elements, as far as the device can
/// address them, beside the standard library's on one thread.
std::vector<BenchRow> bench_parallel(Device& device);

} // namespace argand
