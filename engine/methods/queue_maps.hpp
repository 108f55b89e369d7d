#pragma once

#include "methods/method.hpp"
#include "methods/queue_options.hpp"
#include "photon/queue_map.hpp"

#include <optional>

namespace argand {

/// How the map of a queue is made.
struct QueueMapSettings {
    QueueRebuild rebuild = QueueRebuild::none;
    SampledPart corrected;               ///< in which area samples surround every query
    double reach = 0;                    ///< radius of search
    std::optional<FootprintScale> scale; ///< of footprints; none: the estimator uses points
};

/// The map of what is in the queue, whose blocks are weighed, by the queue's own cells or by a tree
/// that is built for it (in `workspace`). Waits for the device.
PhotonMap make_queue_map(RenderContext& context, PhotonQueue& queue, PhotonWorkspace& workspace,
                         const QueueMapSettings& settings);

} // namespace argand
