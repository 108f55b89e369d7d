#pragma once

#include "methods/option.hpp"

#include <cstdint>
#include <optional>
#include <vector>

namespace argand {

/// What divides space into the cells of a photons queue first: the planes of the triangles' kd-tree
/// (Shi 2012, §3.3), or where photons lie alone.
enum class QueueCells : std::uint8_t { triangles, photons };

/// How densities are estimated from the photons of a queue.
enum class QueueEstimator : std::uint8_t { radius, nearest, footprints };

/// The tree that is built for each frame over all photons of the window, for comparison: none, that
/// of other methods, or a kd-tree of the photons' own (Shi 2012, §4.1).
enum class QueueRebuild : std::uint8_t { none, lbvh, kdtree };

/// How new photons are sorted into cells: each descends to its cell, or each cell tests all of them
/// (Shi 2012, algorithm 1).
enum class QueueClassify : std::uint8_t { descent, leaves };

/// Options of the method `photon-queue` (docs/methods/photon-queue.md).
struct QueueOptions {
    std::uint32_t window = 10;       ///< frames in which all photons are replaced
    std::optional<double> half_life; ///< of photons where light moves, in frames; none: from the
                                     ///< motion
    bool fills = true; ///< an empty queue is filled at once; else by a block in each frame
    QueueRebuild rebuild = QueueRebuild::none;
    QueueClassify classify = QueueClassify::descent;
    bool direct = false; ///< photons account for direct light too, in the place of shadow rays
    bool shows_photons = false; ///< the picture shows photons as points
    QueueCells cells = QueueCells::triangles;
    QueueEstimator estimator = QueueEstimator::radius;
};

/// Throws UsageError if options contradict one another.
QueueOptions queue_options_of(const RenderSettings& settings);

/// The method's options: its own, and those that it shares.
std::vector<Option> all_queue_options();

} // namespace argand
