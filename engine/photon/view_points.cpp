#include "photon/view_points.hpp"

#include "shared/photon.h"

#include <algorithm>
#include <bit>
#include <utility>

namespace argand {

namespace {

/// The points in random order, so that the first of a cell lies anywhere in it.
std::vector<ViewPointRecord> shuffled(const std::vector<ViewPointRecord>& points) {
    std::vector<std::pair<std::uint32_t, std::uint32_t>> order(points.size());
    for (std::uint32_t i = 0; i < order.size(); ++i) {
        order[i] = {pcg4d({i, 0x71e3u, 0, 0}).x, i};
    }
    std::sort(order.begin(), order.end());
    std::vector<ViewPointRecord> result;
    result.reserve(points.size());
    for (const auto& [random, i] : order) {
        result.push_back(points[i]);
    }
    return result;
}

/// Sets the bits of the cells from which view_link_search finds this one.
void mark_around(const glm::uvec4& cell, std::uint32_t mask, std::vector<std::uint32_t>& filter) {
    const int axis = static_cast<int>(cell.w / 2);
    for (int a = -view_cell_rings; a <= view_cell_rings; ++a) {
        for (int b = -view_cell_rings; b <= view_cell_rings; ++b) {
            for (int layer = -1; layer <= 1; ++layer) {
                glm::uvec4 other = cell;
                other[axis] += static_cast<std::uint32_t>(layer);
                other[(axis + 1) % 3] += static_cast<std::uint32_t>(a);
                other[(axis + 2) % 3] += static_cast<std::uint32_t>(b);
                const std::uint32_t bit = view_filter_bit(other, mask);
                filter[bit / 32] |= 1u << (bit % 32);
            }
        }
    }
}

} // namespace

ViewPoints make_view_points(Device& device, const std::vector<ViewPointRecord>& points,
                            double radius) {
    const double cell = std::max(radius / view_cell_rings, 1e-30);
    const auto entries = std::bit_ceil(static_cast<std::uint32_t>(2 * points.size() + 1));
    const std::uint32_t mask = entries - 1;
    std::vector<ViewPointRecord> table(entries, ViewPointRecord{.normal = no_view_point});
    std::vector<std::uint32_t> filter(std::uint64_t(entries) * view_filter_bits / 32);
    for (ViewPointRecord& p : shuffled(points)) {
        p.cell = view_cell({p.x, p.y, p.z}, unpack_photon_normal(p.normal),
                           static_cast<float>(1 / cell));
        std::uint32_t entry = view_cell_entry(p.cell, mask);
        while (table[entry].normal != no_view_point && table[entry].cell != p.cell) {
            entry = (entry + 1) & mask;
        }
        if (table[entry].normal == no_view_point) {
            table[entry] = p;
            mark_around(p.cell, mask, filter);
        }
    }
    return {.table = upload<ViewPointRecord>(device, "points in view", table),
            .near = upload<std::uint32_t>(device, "cells near points in view", filter),
            .unlinked = device.allocate("cells with unlinked areas", filter.size() * 4),
            .cell = cell};
}

} // namespace argand
