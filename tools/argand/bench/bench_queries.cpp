#include "bench_queries.hpp"

#include "shared/bsdf.h"
#include "shared/path_records.h"
#include "shared/photon.h"

#include <numeric>

namespace argand {

QueryRecord bench_query(const glm::vec3& place, const glm::vec3& normal) {
    return {.x = place.x,
            .y = place.y,
            .z = place.z,
            .geometric_normal = pack_unit(normal),
            .flags = query_front | query_lambertian,
            .reflectance_r = bench_reflectance,
            .reflectance_g = bench_reflectance,
            .reflectance_b = bench_reflectance};
}

PhotonQueries bench_queries(Device& device, const std::vector<QueryRecord>& records) {
    const std::uint64_t n = records.size();
    std::vector<std::uint32_t> slots(n);
    std::iota(slots.begin(), slots.end(), 0u);
    const Buffer number =
        upload(device, "bench counts", std::vector{static_cast<std::uint32_t>(n)});
    return {.points = upload(device, "bench queries", records),
            .bsdfs = device.allocate("bench query BSDFs", sizeof(QueryBsdfRecord)),
            .slots = upload(device, "bench slots", slots),
            .count = Count(number, 0, n),
            .estimates = device.allocate("bench estimates", n * sizeof(EstimateRecord)),
            .suspended = device.allocate("bench suspended", n * sizeof(GatherRecord)),
            .unfinished = upload(device, "bench unfinished", std::vector{0u})};
}

} // namespace argand
