#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <thread>
#include <vector>

namespace argand {

/// Calls f(i) for 0 <= i < count, on as many threads as there are cores. f must not throw.
template <class F> void for_each_on_all_cores(std::size_t count, const F& f) {
    std::atomic<std::size_t> next = 0;
    const auto work = [&] {
        for (std::size_t i = next++; i < count; i = next++) {
            f(i);
        }
    };
    const std::size_t cores = std::max(std::thread::hardware_concurrency(), 1u);
    std::vector<std::jthread> others;
    others.reserve(cores);
    for (std::size_t i = 1; i < std::min(cores, count); ++i) {
        others.emplace_back(work);
    }
    work();
}

} // namespace argand
