// Photon maps of photons made by hand, and queries of them at points given by hand.
#pragma once

#include "methods/rendering.hpp"
#include "photon/gather.hpp"
#include "shared/bsdf.h"
#include "shared/query_record.h"

#include <vector>

namespace argand::testing {

struct Query {
    glm::vec3 position{0};
    glm::vec3 normal{0, 1, 0};
};

/// What a query is answered.
struct Gathered {
    glm::dvec3 indirect{0}, caustic{0};
    bool operator==(const Gathered&) const = default;
};

/// As if these had been traced.
inline StoredPhotons store(Device& device, PhotonWorkspace& workspace,
                           const std::vector<PhotonRecord>& photons,
                           const std::vector<glm::uvec4>& offsets = {}) {
    device.upload(workspace.photons, 0, std::as_bytes(std::span(photons)));
    device.upload(workspace.offsets, 0, std::as_bytes(std::span(offsets)));
    std::vector<std::uint32_t> counters(counter_count, 0);
    counters[counter_stored_slots] = static_cast<std::uint32_t>(photons.size());
    device.upload(workspace.counters, 0, std::as_bytes(std::span(counters)));
    return {photons.size(), photons.size()};
}

/// Queries of what the scene's first material scatters.
inline GatherTarget target_of(Device& device, const std::vector<Query>& queries,
                              std::uint32_t part = map_whole) {
    std::vector<std::uint32_t> slots;
    std::vector<QueryRecord> records;
    for (const Query& q : queries) {
        const std::uint32_t normal = pack_unit(q.normal);
        slots.push_back(static_cast<std::uint32_t>(slots.size()));
        records.push_back({q.position.x, q.position.y, q.position.z, 0, 1, 1, 1, normal, normal,
                           normal, LOBE_DIFFUSE, query_front});
    }
    const std::size_t n = queries.size();
    return {.slots = upload(device, "slots", slots),
            .counts = upload(device, "counts",
                             std::vector<std::uint32_t>{static_cast<std::uint32_t>(n), 0, 0, 0}),
            .queries = upload(device, "queries", records),
            .estimates = upload(device, "estimates", std::vector<EstimateRecord>(n)),
            .partial = device.allocate("partial", n * sizeof(GatherRecord)),
            .part = part};
}

/// The answers, after `gather` has written them; finished: whether no query ran out of its budget.
template <class Gather>
std::vector<Gathered> answers(Device& device, const std::vector<Query>& queries, bool careful,
                              std::uint32_t part, bool& finished, const Gather& gather) {
    const std::size_t n = queries.size();
    const GatherTarget target = target_of(device, queries, part);
    Traversal traversal = make_traversal(device, n);
    traversal.careful = careful;
    device.fill(traversal.unfinished, 0);
    gather(target, traversal, Count(target.counts, 0, n));
    finished = download<std::uint32_t>(device, traversal.unfinished, 1)[0] == 0;
    std::vector<Gathered> result;
    for (const EstimateRecord& e : download<EstimateRecord>(device, target.estimates, n)) {
        result.push_back(
            {{e.indirect_r, e.indirect_g, e.indirect_b}, {e.caustic_r, e.caustic_g, e.caustic_b}});
    }
    return result;
}

} // namespace argand::testing
