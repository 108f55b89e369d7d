#include "bench.hpp"

#include <algorithm>
#include <chrono>

namespace argand {

namespace {

constexpr int least_runs = 5;
constexpr int most_runs = 101;
constexpr double enough_seconds = 0.3;

double clock_seconds() {
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch())
        .count();
}

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

double median(std::vector<double> values) {
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

double median_device_seconds(Device& device, const std::function<void()>& prepare,
                             const std::function<void()>& work) {
    return median_of_runs([&] {
        prepare();
        device.reset_stage_times(); // waits
        const double begin = clock_seconds();
        {
            const StageScope stage(device, "bench");
            work();
        }
        const std::vector<StageTime> times = device.stage_times();
        const double elapsed = clock_seconds() - begin;
        return device.info().features.timestamps ? times.front().seconds : elapsed;
    });
}

double median_host_seconds(const std::function<void()>& prepare,
                           const std::function<void()>& work) {
    return median_of_runs([&] {
        prepare();
        const double begin = clock_seconds();
        work();
        return clock_seconds() - begin;
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
