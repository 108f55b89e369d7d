#pragma once

#include "base/archive.hpp"
#include "photon/queue_paths.hpp"

#include <cstdint>
#include <span>
#include <vector>

namespace argand {

/// What the photons of a queue's blocks are worth.
struct QueueAges {
    std::uint32_t lights = 1;           ///< that photons tell apart
    std::vector<std::uint64_t> emitted; ///< photons of each block
    /// How much older the photons of a block and a light are than those of the last frame, in
    /// half-lives: block * lights + light.
    std::vector<double> half_lives;
};

QueueAges make_ages(std::uint32_t window, std::uint32_t lights);

/// Saves or loads them.
void persist_ages(Archive& archive, QueueAges& ages);

/// A block is traced: it is of now.
void renew(QueueAges& ages, std::uint32_t block, std::uint64_t emitted);

/// All photons of a light grow older.
void grow_older(QueueAges& ages, std::uint32_t light, double half_lives);

/// Sets the weights of the queue's blocks by these ages. Those of each light sum to 1.
void weigh_blocks(PhotonQueue& queue, const QueueAges& ages);

/// Photons of even weight that have the noise of those in the queue as they are weighed: Kish's
/// effective number, (sum w)^2 / sum w^2. 0 if there are none. shares: of each light among the
/// photons that are emitted; they sum to 1. crossed: their parts where only some blocks count.
double effective_photons(const PhotonQueue& queue, const QueueAges& ages,
                         std::span<const double> shares, std::span<const CrossedShare> crossed);

} // namespace argand
