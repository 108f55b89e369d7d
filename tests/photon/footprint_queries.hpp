// Asking a photon map for footprints at points given by hand.
#pragma once

#include "methods/rendering.hpp"
#include "photon/gather.hpp"
#include "shared/bsdf.h"
#include "shared/path_records.h"
#include "shared/query_record.h"

#include <vector>

namespace argand::testing {

struct Query {
    glm::vec3 position{0};
    glm::vec3 normal{0, 1, 0};
};

/// What a query adds to a path's layers.
struct Gathered {
    glm::dvec3 indirect{0}, caustic{0};
    bool operator==(const Gathered&) const = default;
};

struct QuerySettings {
    std::uint32_t budget = gather_budget;
    bool uniform_kernel = false;
    bool careful = true;
};

/// Asks for what the scene's first material scatters. `finished`: whether no query ran out of its budget.
inline std::vector<Gathered> gather(Device& device, const DeviceScene& scene, const PhotonMap& map,
                                    const std::vector<Query>& queries, const QuerySettings& settings,
                                    bool& finished) {
    const std::size_t n = queries.size();
    std::vector<std::uint32_t> active;
    std::vector<QueryRecord> records;
    for (const Query& q : queries) {
        const std::uint32_t normal = pack_unit(q.normal);
        active.push_back(static_cast<std::uint32_t>(active.size()));
        records.push_back(
            {q.position.x, q.position.y, q.position.z, 0, 1, 1, 1, normal, normal, normal, LOBE_DIFFUSE, 1});
    }
    const GatherTarget target{
        .slots = upload(device, "slots", active),
        .counts = upload(device, "counts", std::vector<std::uint32_t>{std::uint32_t(n), 0, 0, 0}),
        .queries = upload(device, "queries", records),
        .layers = upload(device, "layers", std::vector<LayersRecord>(n)),
        .partial = device.allocate("partial", n * sizeof(GatherRecord))};
    Traversal traversal = make_traversal(device, n);
    traversal.careful = settings.careful;
    device.fill(traversal.unfinished, 0);
    gather_footprints(device, scene, map, target, traversal, settings.uniform_kernel,
                      Count(target.counts, 0, n), settings.budget);
    finished = download<std::uint32_t>(device, traversal.unfinished, 1)[0] == 0;
    std::vector<Gathered> result;
    for (const LayersRecord& l : download<LayersRecord>(device, target.layers, n)) {
        result.push_back(
            {{l.indirect_r, l.indirect_g, l.indirect_b}, {l.caustic_r, l.caustic_g, l.caustic_b}});
    }
    return result;
}

} // namespace argand::testing
