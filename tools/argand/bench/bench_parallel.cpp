#include "bench.hpp"
#include "parallel/compact.hpp"
#include "parallel/radix_sort.hpp"
#include "parallel/reduce.hpp"
#include "parallel/scan.hpp"
#include "parallel/segments.hpp"
#include "shared/geometry_records.h"

#include <algorithm>
#include <numeric>
#include <random>

namespace argand {

namespace {

struct Pair {
    std::uint32_t key;
    std::uint32_t value;
};

struct Pair64 {
    std::uint64_t key;
    std::uint32_t value;
};

template <class T> std::vector<T> random_data(std::size_t n) {
    std::mt19937_64 random(n);
    std::vector<T> data(n);
    for (T& element : data) {
        element = static_cast<T>(random());
    }
    return data;
}

/// Data that all measurements of one size share.
struct Bench {
    Device& device;
    std::size_t n;
    double copy_bytes_per_second;
    std::vector<BenchRow>& rows;

    void add(const char* name, double bytes_per_item, double seconds, const char* peer,
             double peer_seconds) const {
        const auto items = static_cast<double>(n);
        rows.push_back({.name = name,
                        .n = n,
                        .seconds = seconds,
                        .rate = items / seconds,
                        .unit = "elements/s",
                        .bound = copy_bytes_per_second / bytes_per_item,
                        .peer = peer,
                        .peer_rate = items / peer_seconds});
    }
};

void nothing() {}

void bench_reduce(const Bench& bench, const std::vector<std::uint32_t>& data, const Buffer& in) {
    const Buffer out = bench.device.allocate("bench: result", sizeof(std::uint32_t));
    volatile std::uint32_t sum = 0; // keeps the compiler from removing the peer's work
    bench.add("reduce_sum", 4,
              median_device_seconds(bench.device, nothing,
                                    [&] { reduce_sum(bench.device, in, out, 0, bench.n); }),
              "std::reduce", median_host_seconds(nothing, [&] {
                  sum = std::reduce(data.begin(), data.end(), 0u);
              }));
}

void bench_scan(const Bench& bench, const std::vector<std::uint32_t>& data, const Buffer& in) {
    const Buffer out = bench.device.allocate("bench: scanned", bench.n * sizeof(std::uint32_t));
    std::vector<std::uint32_t> host(bench.n);
    bench.add("exclusive_scan", 12,
              median_device_seconds(bench.device, nothing,
                                    [&] { exclusive_scan(bench.device, in, out, bench.n); }),
              "std::exclusive_scan", median_host_seconds(nothing, [&] {
                  std::exclusive_scan(data.begin(), data.end(), host.begin(), 0u);
              }));
}

/// Segments of about 64 elements.
struct BenchSegments {
    std::vector<std::uint32_t> heads, of_elements;
    std::vector<SegmentRange> ranges;
};

BenchSegments random_segments(const std::vector<std::uint32_t>& data) {
    BenchSegments segments;
    segments.heads.reserve(data.size());
    segments.of_elements.reserve(data.size());
    for (std::uint32_t i = 0; i < data.size(); ++i) {
        const bool head = i == 0 || data[i] >> 26 == 0;
        if (head) {
            segments.ranges.push_back({i, 0});
        }
        ++segments.ranges.back().count;
        segments.heads.push_back(head ? 1 : 0);
        segments.of_elements.push_back(static_cast<std::uint32_t>(segments.ranges.size() - 1));
    }
    return segments;
}

void bench_segments(const Bench& bench, const std::vector<std::uint32_t>& data, const Buffer& in) {
    Device& device = bench.device;
    const auto n = static_cast<std::uint32_t>(bench.n);
    const BenchSegments segments = random_segments(data);
    const auto count = static_cast<std::uint32_t>(segments.ranges.size());
    const Buffer heads = upload(device, "bench: heads", segments.heads);
    const Segments of{.of_elements = upload(device, "bench: segments", segments.of_elements),
                      .ranges = upload(device, "bench: ranges", segments.ranges),
                      .end = n};
    const Buffer out = device.allocate("bench: scanned", n * sizeof(std::uint32_t));
    std::vector<std::uint32_t> host(n);
    bench.add("segmented_scan", 4 + 2 * 8,
              median_device_seconds(device, nothing,
                                    [&] { segmented_scan(device, in, heads, out, bench.n); }),
              "serial loop", median_host_seconds(nothing, [&] {
                  std::uint32_t sum = 0;
                  for (std::uint32_t i = 0; i < n; ++i) {
                      sum = segments.heads[i] != 0 ? data[i] : sum + data[i];
                      host[i] = sum;
                  }
              }));

    // A point for every fourth element of the data, which is what fits.
    std::vector<glm::vec4> points(n / 4);
    for (std::uint32_t i = 0; i < n / 4; ++i) {
        points[i] = glm::vec4(float(data[i]), float(~data[i]), 0, 0);
    }
    const Buffer elements = upload(device, "bench: points", points);
    const Buffer boxes = device.allocate("bench: boxes", count * sizeof(BoxRecord));
    std::vector<BoxRecord> host_boxes(count);
    const Bench of_points{device, points.size(), bench.copy_bytes_per_second, bench.rows};
    of_points.add("segment_boxes", 20,
                  median_device_seconds(device, nothing,
                                        [&] {
                                            segment_boxes(
                                                device, elements, Lanes::point,
                                                {.of_elements = of.of_elements, .end = n / 4},
                                                count, boxes);
                                        }),
                  "serial loop", median_host_seconds(nothing, [&] {
                      for (std::uint32_t i = 0; i < n / 4; ++i) {
                          BoxRecord& box = host_boxes[segments.of_elements[i]];
                          box.low_x = std::min(box.low_x, points[i].x);
                          box.low_y = std::min(box.low_y, points[i].y);
                          box.high_x = std::max(box.high_x, points[i].x);
                          box.high_y = std::max(box.high_y, points[i].y);
                      }
                  }));

    std::vector<std::uint32_t> flags(n);
    std::transform(data.begin(), data.end(), flags.begin(),
                   [](std::uint32_t x) { return x >> 16 & 1u; });
    const Buffer device_flags = upload(device, "bench: flags", flags);
    const Buffer sums = device.allocate("bench: sums", n * sizeof(std::uint32_t));
    const Buffer lefts = device.allocate("bench: lefts", count * sizeof(std::uint32_t));
    bench.add("partition_segments", 12 + 4 * 4,
              median_device_seconds(
                  device, nothing,
                  [&] { partition_segments(device, device_flags, of, sums, out, lefts); }),
              "std::stable_partition",
              median_host_seconds([&] { host = data; },
                                  [&] {
                                      for (const SegmentRange& s : segments.ranges) {
                                          std::stable_partition(
                                              host.begin() + s.first,
                                              host.begin() + s.first + s.count,
                                              [](std::uint32_t x) { return (x >> 16 & 1u) != 0; });
                                      }
                                  }));

    const std::uint32_t copies = std::accumulate(flags.begin(), flags.end(), 0u);
    bench.add("expand", 12 + 4,
              median_device_seconds(device, nothing,
                                    [&] { expand(device, device_flags, n, copies, sums, out); }),
              "serial loop", median_host_seconds(nothing, [&] {
                  std::uint32_t to = 0;
                  for (std::uint32_t i = 0; i < n; ++i) {
                      for (std::uint32_t k = 0; k < flags[i]; ++k) {
                          host[to++] = i;
                      }
                  }
              }));
}

void bench_compact(const Bench& bench, const std::vector<std::uint32_t>& data, const Buffer& in) {
    std::vector<std::uint32_t> flags(bench.n);
    std::transform(data.begin(), data.end(), flags.begin(),
                   [](std::uint32_t x) { return x >> 16 & 1u; });
    const Buffer device_flags = upload(bench.device, "bench: flags", flags);
    const Buffer out = bench.device.allocate("bench: kept", bench.n * sizeof(std::uint32_t));
    const Buffer counts = bench.device.allocate("bench: counts", sizeof(std::uint32_t));
    std::vector<std::uint32_t> host(bench.n);
    bench.add("compact", 14,
              median_device_seconds(
                  bench.device, nothing,
                  [&] {
                      compact(bench.device, device_flags, in, out, {counts, 0}, bench.n);
                  }),
              "std::copy_if", median_host_seconds(nothing, [&] {
                  std::copy_if(data.begin(), data.end(), host.begin(),
                               [](std::uint32_t x) { return (x >> 16 & 1u) != 0; });
              }));
}

template <class Element> double sort_seconds(const std::vector<Element>& data) {
    std::vector<Element> host;
    return median_host_seconds([&] { host = data; },
                               [&] {
                                   std::sort(host.begin(), host.end(),
                                             [](const Element& a, const Element& b) {
                                                 if constexpr (requires { a.key; }) {
                                                     return a.key < b.key;
                                                 } else {
                                                     return a < b;
                                                 }
                                             });
                               });
}

/// Each pass of a sort reads the keys twice and the values once, and writes both.
void bench_sorts(const Bench& bench, const std::vector<std::uint32_t>& data, const Buffer& in) {
    Device& device = bench.device;
    const std::size_t n = bench.n;
    const std::vector<std::uint64_t> data64 = random_data<std::uint64_t>(n);
    const Buffer in64 = upload(device, "bench: 64-bit keys", data64);
    const Buffer keys = device.allocate("bench: sorted keys", n * sizeof(std::uint64_t));
    const Buffer values = device.allocate("bench: sorted values", n * sizeof(std::uint32_t));
    const auto reset = [&] { device.copy(in, keys); };
    const auto reset64 = [&] { device.copy(in64, keys); };

    std::vector<Pair> pairs(n);
    std::vector<Pair64> pairs64(n);
    for (std::size_t i = 0; i < n; ++i) {
        pairs[i] = {data[i], static_cast<std::uint32_t>(i)};
        pairs64[i] = {data64[i], static_cast<std::uint32_t>(i)};
    }
    bench.add("radix_sort", 4 * 12,
              median_device_seconds(device, reset, [&] { radix_sort(device, keys, n); }),
              "std::sort", sort_seconds(data));
    bench.add(
        "radix_sort_pairs", 4 * 20,
        median_device_seconds(device, reset, [&] { radix_sort_pairs(device, keys, values, n); }),
        "std::sort", sort_seconds(pairs));
    bench.add("radix_sort_pairs64", 8 * 32,
              median_device_seconds(device, reset64,
                                    [&] { radix_sort_pairs64(device, keys, values, n); }),
              "std::sort", sort_seconds(pairs64));
}

} // namespace

std::vector<BenchRow> bench_parallel(Device& device) {
    std::vector<BenchRow> rows;
    const double copied = copy_rate(device);
    // The 64-bit keys need the largest buffer.
    const std::uint64_t most = device.info().limits.storage_range / sizeof(std::uint64_t);
    for (std::uint32_t log_n = 10; log_n <= 24 && std::uint64_t(1) << log_n <= most; log_n += 2) {
        const Bench bench{device, std::size_t(1) << log_n, copied, rows};
        const std::vector<std::uint32_t> data = random_data<std::uint32_t>(bench.n);
        const Buffer in = upload(device, "bench: elements", data);
        bench_reduce(bench, data, in);
        bench_scan(bench, data, in);
        bench_compact(bench, data, in);
        bench_segments(bench, data, in);
        bench_sorts(bench, data, in);
    }
    return rows;
}

} // namespace argand
