// Photon maps of photons made by hand, and queries at points made by hand.
#pragma once

#include "methods/rendering.hpp"
#include "photon/gather.hpp"
#include "shared/bsdf.h"
#include "shared/photon.h"
#include "shared/query_record.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace argand::testing {

struct Query {
    glm::vec3 position{0};
    glm::vec3 normal{0, 1, 0};
};

/// The estimate at a query.
struct Gathered {
    glm::dvec3 indirect{0}, caustic{0};
    double uneven = 0; ///< unevenness() of the indirect light
    bool operator==(const Gathered&) const = default;
};

/// By how much a chord from a query to a photon exceeds what is allowed along the sum of the
/// normals at its ends (`on_same_surface` of the kernels); positive: the photon is on another
/// surface.
inline double bend_beyond(const Query& query, glm::dvec3 normal, glm::dvec3 chord) {
    const glm::dvec3 own(query.normal), p = glm::abs(glm::dvec3(query.position));
    const double rounding = std::max({p.x, p.y, p.z}) * double(position_rounding);
    const double tolerance = std::min(std::hypot(double(flat_tolerance), glm::length(normal - own)),
                                      double(chord_tolerance));
    return std::abs(glm::dot(chord, own + normal)) - rounding - tolerance * glm::length(chord);
}

/// Stores the photons as if they had been traced.
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

/// How queries are answered.
struct Answering {
    bool until_complete = true;
    std::uint32_t part = map_whole;
    float albedo = 0.5f; ///< of the surfaces
};

/// The queries on the device, at Lambertian surfaces of this albedo.
inline PhotonQueries upload_queries(Device& device, const std::vector<Query>& queries,
                                    const Answering& how) {
    const float reflectance = how.albedo * INV_PI;
    std::vector<std::uint32_t> slots;
    std::vector<QueryRecord> records;
    for (const Query& q : queries) {
        const std::uint32_t normal = pack_unit(q.normal);
        slots.push_back(static_cast<std::uint32_t>(slots.size()));
        records.push_back({.x = q.position.x,
                           .y = q.position.y,
                           .z = q.position.z,
                           .geometric_normal = normal,
                           .flags = query_front | query_lambertian,
                           .reflectance_r = reflectance,
                           .reflectance_g = reflectance,
                           .reflectance_b = reflectance});
    }
    const std::size_t n = queries.size();
    const Buffer number = upload(
        device, "counts", std::vector<std::uint32_t>{static_cast<std::uint32_t>(n), 0, 0, 0});
    return {.points = upload(device, "queries", records),
            .bsdfs = device.allocate("query BSDFs", n * sizeof(QueryBsdfRecord)),
            .slots = upload(device, "slots", slots),
            .count = Count(number, 0, n),
            .estimates = upload(device, "estimates", std::vector<EstimateRecord>(n)),
            .suspended = device.allocate("suspended", n * sizeof(GatherRecord)),
            .unfinished = upload(device, "unfinished", std::vector<std::uint32_t>{0}),
            .until_complete = how.until_complete,
            .part = how.part};
}

/// The estimates; finished: whether no query ran out of its budget.
inline std::vector<Gathered> answers(Device& device, PhotonEstimator& estimator,
                                     const PhotonMap& map, const std::vector<Query>& queries,
                                     const Answering& how, bool& finished) {
    const PhotonQueries on_device = upload_queries(device, queries, how);
    estimator.estimate(map, on_device);
    finished = download<std::uint32_t>(device, on_device.unfinished, 1)[0] == 0;
    std::vector<Gathered> result;
    for (const EstimateRecord& e :
         download<EstimateRecord>(device, on_device.estimates, queries.size())) {
        result.push_back({{e.indirect_r, e.indirect_g, e.indirect_b},
                          {e.caustic_r, e.caustic_g, e.caustic_b},
                          e.uneven});
    }
    return result;
}

} // namespace argand::testing
