#include "base/clock.hpp"
#include "base/median.hpp"
#include "bench.hpp"

#include <algorithm>

namespace argand {

namespace {

constexpr int least_runs = 5;
constexpr int most_runs = 101;
constexpr double enough_seconds = 0.3;

/// Median of the values that `run` returns, over several runs.
double median_of_runs(const std::function<double()>& run) {
    run(); // warms up caches and compiles kernels
    std::vector<double> seconds;
    double sum = 0;
    while (static_cast<int>(seconds.size()) < least_runs ||
           (sum < enough_seconds && static_cast<int>(seconds.size()) < most_runs)) {
        seconds.push_back(run());
        sum += seconds.back();
    }
    return median(std::move(seconds));
}

} // namespace

double median_device_seconds(Device& device, const std::function<void()>& prepare,
                             const std::function<void()>& work) {
    return median_of_runs([&] {
        prepare();
        device.reset_stage_times(); // waits
        const Clock::time_point begin = Clock::now();
        {
            const StageScope stage(device, "bench");
            work();
        }
        const std::vector<StageTime> times = device.stage_times();
        const double elapsed = seconds_since(begin);
        return device.info().features.timestamps ? times.front().seconds : elapsed;
    });
}

double median_host_seconds(const std::function<void()>& prepare,
                           const std::function<void()>& work) {
    return median_of_runs([&] {
        prepare();
        const Clock::time_point begin = Clock::now();
        work();
        return seconds_since(begin);
    });
}

double copy_rate(Device& device) {
    const std::uint64_t bytes =
        std::min<std::uint64_t>({std::uint64_t(64) << 20, device.info().limits.storage_range,
                                 device.info().limits.memory / 4});
    const Buffer from = device.allocate("bench: copied from", bytes);
    const Buffer to = device.allocate("bench: copied to", bytes);
    device.fill(from, 1);
    const double seconds = median_device_seconds(
        device, [] {}, [&] { device.copy(from, to); });
    return 2.0 * static_cast<double>(bytes) / seconds;
}

} // namespace argand
