#include "world/area_table.hpp"

#include "device/copy_elements.hpp"
#include "kernels/area_carries.hpp"
#include "kernels/area_codes.hpp"
#include "kernels/area_counts.hpp"
#include "kernels/area_divide.hpp"
#include "kernels/area_duplicates.hpp"
#include "kernels/area_table.hpp"
#include "kernels/area_triangles.hpp"
#include "kernels/area_units.hpp"
#include "parallel/radix_sort.hpp"
#include "parallel/reduce.hpp"
#include "parallel/scan.hpp"
#include "scene/texture_range.hpp"
#include "shared/area_records.h"
#include "shared/follow.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <vector>

namespace argand {

namespace {

constexpr std::uint64_t word = sizeof(std::uint32_t);
constexpr std::uint32_t bits_of_code = 30;
// Pieces are not divided into more, unless the scene has more triangles: long needles that cross a
// small part would have millions. A map has room for as many samples.
constexpr std::uint32_t most_pieces = 1u << 20;

/// Pieces of triangles: uvec2 of triangle and number (shared/triangle_piece.h).
struct Pieces {
    Buffer list;
    std::uint32_t count = 0;
};

/// For each material whether photons are stored on it.
std::vector<std::uint32_t> which_store(const Scene& scene, float follow_roughness) {
    std::vector<std::uint32_t> stores;
    stores.reserve(scene.materials.size());
    for (const Material& material : scene.materials) {
        const auto lobes = [&](const MaterialRecord& record) {
            return estimated_lobes(record, follow_roughness);
        };
        stores.push_back(lobes_anywhere(scene, material, lobes) != 0 ? 1 : 0);
    }
    return stores;
}

/// Name of the scratch memory for pieces that a list does not use.
const char* other_than(const Buffer& list) {
    return list.name() == "area pieces" ? "area pieces, divided" : "area pieces";
}

/// Divides triangles until their pieces fit the sampled part, and leaves out those outside.
Pieces pieces_within(Device& device, const PhotonSurfaces& surfaces, const SampledPart& part,
                     const Buffer& state) {
    Pieces pieces{.list = state, .count = surfaces.triangle_count};
    AreaPieceParams params{.count = pieces.count,
                           .of_triangles = 1,
                           .reach = static_cast<float>(part.reach),
                           .center_x = part.center.x,
                           .center_y = part.center.y,
                           .center_z = part.center.z};
    for (bool divides = true; divides && pieces.count > 0;) {
        params.count = pieces.count;
        const std::uint64_t ends = std::uint64_t(pieces.count) + 1;
        const Buffer places = device.scratch("area pieces' places", ends * word);
        dispatch(device,
                 kernels::area_counts{.positions = surfaces.positions,
                                      .triangles = surfaces.triangles,
                                      .areas = surfaces.areas,
                                      .pieces = pieces.list,
                                      .counts = places,
                                      .params = params},
                 ends);
        reduce_max(device, places, state, area_state_most, ends);
        exclusive_scan(device, places, places, ends);
        copy_elements(device, places, pieces.count, state, area_state_pieces, 1, word);
        const auto found = download<std::uint32_t>(device, state, area_state_pieces + 1);
        divides = found[area_state_most] > 1;
        if (divides && params.of_triangles == 0 &&
            found[area_state_pieces] > std::max(most_pieces, surfaces.triangle_count)) {
            break;
        }
        const Pieces divided{
            .list = device.scratch(other_than(pieces.list),
                                   std::max<std::uint64_t>(found[area_state_pieces], 1) *
                                       sizeof(glm::uvec2)),
            .count = found[area_state_pieces]};
        dispatch(
            device,
            kernels::area_divide{
                .pieces = pieces.list, .places = places, .divided = divided.list, .params = params},
            pieces.count);
        pieces = divided;
        params.of_triangles = 0;
    }
    return pieces;
}

/// Brings the pieces into the order of the curve. Returns the indices of pieces in this order;
/// leaves the bits of the largest area in `state`.
Buffer order_along_curve(Device& device, const PhotonSurfaces& surfaces, const Pieces& pieces,
                         const Buffer& state) {
    const glm::vec3& low = surfaces.box.low;
    const glm::vec3& high = surfaces.box.high;
    const Buffer codes = device.scratch("area codes", pieces.count * word);
    Buffer order = device.scratch("area order", pieces.count * word);
    const Buffer areas = device.scratch("areas of pieces", pieces.count * word);
    dispatch(device,
             kernels::area_codes{.positions = surfaces.positions,
                                 .triangles = surfaces.triangles,
                                 .areas = surfaces.areas,
                                 .pieces = pieces.list,
                                 .codes = codes,
                                 .order = order,
                                 .area_bits = areas,
                                 .params = {.count = pieces.count,
                                            .low_x = low.x,
                                            .low_y = low.y,
                                            .low_z = low.z,
                                            .high_x = high.x,
                                            .high_y = high.y,
                                            .high_z = high.z}},
             pieces.count);
    reduce_max(device, areas, state, area_state_largest, pieces.count);
    radix_sort_pairs(device, codes, order, pieces.count, bits_of_code);
    return order;
}

/// Sums the areas in their order. Waits for the device.
SampledAreas summed(Device& device, const PhotonSurfaces& surfaces, const Pieces& pieces,
                    const Buffer& order, const Buffer& state) {
    const AreaSumParams params{.count = pieces.count,
                               .headroom_bits =
                                   static_cast<std::uint32_t>(std::bit_width(pieces.count))};
    const std::uint64_t ends = std::uint64_t(pieces.count) + 1;
    const Buffer lows = device.scratch("area sums, low words", ends * word);
    const Buffer highs = device.scratch("area sums, high words", ends * word);
    dispatch(device,
             kernels::area_units{.areas = surfaces.areas,
                                 .pieces = pieces.list,
                                 .order = order,
                                 .area_state = state,
                                 .lows = lows,
                                 .highs = highs,
                                 .params = params},
             ends);
    exclusive_scan(device, lows, lows, ends);
    dispatch(device, kernels::area_carries{.low_sums = lows, .highs = highs, .params = params},
             pieces.count);
    exclusive_scan(device, highs, highs, ends);
    SampledAreas result{.sums = device.allocate("area sums", pieces.count * sizeof(AreaSumRecord)),
                        .pieces = pieces.count};
    dispatch(device,
             kernels::area_table{.pieces = pieces.list,
                                 .order = order,
                                 .low_sums = lows,
                                 .high_sums = highs,
                                 .area_sums = result.sums,
                                 .params = params},
             pieces.count);
    copy_elements(device, lows, pieces.count, state, area_state_sum, 1, word);
    copy_elements(device, highs, pieces.count, state, area_state_sum + 1, 1, word);
    const auto found = download<std::uint32_t>(device, state, area_state_count);
    const double units = found[area_state_sum + 1] * 4294967296.0 + found[area_state_sum];
    result.area = std::ldexp(units, -area_scale(found[area_state_largest], params.headroom_bits));
    return result;
}

} // namespace

PhotonSurfaces find_photon_surfaces(Device& device, const Scene& scene, const Buffer& positions,
                                    const Buffer& triangles, const Bounds& box,
                                    float follow_roughness) {
    const StageScope stage(device, "find areas");
    const auto count = static_cast<std::uint32_t>(scene.triangles.size());
    const std::uint64_t bound = std::max(count, 1u);
    PhotonSurfaces surfaces{.positions = positions,
                            .triangles = triangles,
                            .areas = device.allocate("photon areas", bound * sizeof(glm::vec2)),
                            .triangle_count = count,
                            .box = box};
    if (count == 0) {
        return surfaces;
    }
    const Buffer stores =
        upload(device, "materials that store", which_store(scene, follow_roughness));
    const Buffer hashes = device.scratch("area codes", bound * word);
    const Buffer order = device.scratch("area order", bound * word);
    dispatch(device,
             kernels::area_triangles{.positions = positions,
                                     .triangles = triangles,
                                     .areas = surfaces.areas,
                                     .hashes = hashes,
                                     .order = order,
                                     .params = {count}},
             count);
    radix_sort_pairs(device, hashes, order, count);
    dispatch(device,
             kernels::area_duplicates{.positions = positions,
                                      .triangles = triangles,
                                      .stores = stores,
                                      .hashes = hashes,
                                      .order = order,
                                      .areas = surfaces.areas,
                                      .params = {count}},
             count);
    return surfaces;
}

SampledAreas sample_areas(Device& device, const PhotonSurfaces& surfaces, const SampledPart& part) {
    const StageScope stage(device, "find areas");
    const Buffer state = device.scratch("area state", area_state_count * word);
    const Pieces pieces = pieces_within(device, surfaces, part, state);
    if (pieces.count == 0) {
        return {.sums = device.allocate("area sums", sizeof(AreaSumRecord)), .part = part};
    }
    const Buffer order = order_along_curve(device, surfaces, pieces, state);
    SampledAreas result = summed(device, surfaces, pieces, order, state);
    result.part = part;
    return result;
}

} // namespace argand
