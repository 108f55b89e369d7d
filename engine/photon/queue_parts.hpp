#pragma once

#include "photon/photon_queue.hpp"
#include "shared/queue_records.h"

#include <algorithm>
#include <bit>

/// What the files of the photons queue share.
namespace argand {

inline std::uint64_t queue_room(const PhotonQueue& q) {
    return q.window * q.block_room + q.area_room;
}

inline Buffer block_table(Device& device, const PhotonQueue& q) {
    Buffer table = device.scratch("queue: blocks", q.blocks.size() * sizeof(QueueBlock));
    device.upload(table, 0, std::as_bytes(std::span(q.blocks)));
    return table;
}

inline QueueParams queue_params(const PhotonQueue& q, std::uint64_t count) {
    QueueParams params{};
    params.count = static_cast<uint>(count);
    params.cells = q.cells;
    params.caustic = q.caustic;
    params.blocks = q.window;
    params.leaf_size = q.leaf_size;
    params.lights = q.lights;
    params.vertex_room = static_cast<uint>(q.vertex_room);
    return params;
}

/// Scratch memory of so many words.
inline Buffer scratch_words(Device& device, const char* name, std::uint64_t count) {
    return device.scratch(name, std::max<std::uint64_t>(count, 1) * sizeof(std::uint32_t));
}

} // namespace argand
