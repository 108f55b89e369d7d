#include "accel/stopgap.hpp"

#include "shared/geometry_records.h"
#include <algorithm>
#include <numeric>
namespace argand::stopgap {
static std::size_t number(Device& d, const Count& c) {
    return c.on_device() ? download<std::uint32_t>(d, c.buffer, 1, c.index)[0] : c.bound;
}
void radix_sort_pairs(Device& d, const Buffer& keys, const Buffer& values, const Count& count,
                      std::uint32_t) {
    auto n = number(d, count);
    auto k = download<std::uint32_t>(d, keys, n), v = download<std::uint32_t>(d, values, n);
    std::vector<std::uint32_t> o(n), k2(n), v2(n);
    std::iota(o.begin(), o.end(), 0u);
    std::stable_sort(o.begin(), o.end(), [&](auto a, auto b) { return k[a] < k[b]; });
    for (std::size_t i = 0; i < n; ++i) {
        k2[i] = k[o[i]];
        v2[i] = v[o[i]];
    }
    d.upload(keys, 0, std::as_bytes(std::span(k2)));
    d.upload(values, 0, std::as_bytes(std::span(v2)));
}
void reduce_box(Device& d, const Buffer& boxes, const Buffer& out, std::uint32_t at, const Count& count) {
    auto n = number(d, count);
    auto b = download<BoxRecord>(d, boxes, n);
    BoxRecord r{INFINITY, INFINITY, INFINITY, 0, -INFINITY, -INFINITY, -INFINITY, 0};
    for (auto& x : b) {
        r.low_x = std::min(r.low_x, x.low_x);
        r.low_y = std::min(r.low_y, x.low_y);
        r.low_z = std::min(r.low_z, x.low_z);
        r.high_x = std::max(r.high_x, x.high_x);
        r.high_y = std::max(r.high_y, x.high_y);
        r.high_z = std::max(r.high_z, x.high_z);
    }
    d.upload(out, at * sizeof(r), std::as_bytes(std::span(&r, 1)));
}
} // namespace argand::stopgap
