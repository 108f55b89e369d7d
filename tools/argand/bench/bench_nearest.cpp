#include "bench_nearest.hpp"

#include "nanoflann_peer.hpp"
#include "photon/nearest.hpp"
#include "photon/radius.hpp"
#include "shared/bsdf.h"
#include "shared/path_records.h"
#include "shared/photon.h"
#include "shared/query_record.h"

#include <algorithm>
#include <array>
#include <fmt/format.h>

namespace argand {

std::vector<BenchRow> bench_nearest(Device& device, const DeviceScene& scene,
                                    PhotonWorkspace& workspace, const StoredPhotons& stored) {
    const SortedPhotons sorted = sort_photons(device, workspace, stored);
    const std::vector<PhotonRecord> photons =
        download<PhotonRecord>(device, sorted.photons, stored.photons);
    std::vector<glm::vec3> points;
    std::vector<glm::vec3> asked;
    std::vector<QueryRecord> records;
    std::vector<std::uint32_t> slots;
    for (std::size_t i = 0; i < photons.size(); ++i) {
        const PhotonRecord& p = photons[i];
        points.emplace_back(p.x, p.y, p.z);
        if (i % 8 == 0) {
            const std::uint32_t normal = pack_unit(unpack_photon_normal(p.normal));
            records.push_back({.x = p.x,
                               .y = p.y,
                               .z = p.z,
                               .geometric_normal = normal,
                               .flags = query_front | query_lambertian,
                               .reflectance_r = 0.2f,
                               .reflectance_g = 0.2f,
                               .reflectance_b = 0.2f});
            slots.push_back(static_cast<std::uint32_t>(slots.size()));
            asked.push_back(points.back());
        }
    }
    const std::uint64_t n = asked.size();
    const Buffer number =
        upload(device, "bench counts", std::vector{static_cast<std::uint32_t>(n)});
    const PhotonQueries queries{
        .points = upload(device, "bench queries", records),
        .bsdfs = device.allocate("bench query BSDFs", sizeof(QueryBsdfRecord)),
        .slots = upload(device, "bench slots", slots),
        .count = Count(number, 0, n),
        .estimates = device.allocate("bench estimates", n * sizeof(EstimateRecord)),
        .unfinished = upload(device, "bench unfinished", std::vector{0u})};
    std::vector<glm::vec4> some;
    for (std::size_t i = 0; i < std::min<std::size_t>(n, 2000); ++i) {
        some.emplace_back(asked[i], 0);
    }
    constexpr std::array<std::uint32_t, 3> neighbours{50, 150, 500};
    std::array<double, neighbours.size()> radii{};
    std::transform(neighbours.begin(), neighbours.end(), radii.begin(),
                   [&](std::uint32_t k) { return 2.5 * median_radius(device, sorted, some, k); });
    const PhotonMap map = build_photon_map(device, scene, workspace, stored);
    std::vector<BenchRow> rows;
    for (std::size_t i = 0; i < neighbours.size(); ++i) {
        const std::uint32_t k = neighbours[i];
        NearestEstimator estimator(device, scene.plan, {.neighbours = k, .radius = radii[i]});
        const double seconds = median_host_seconds([&] { device.wait(); },
                                                   [&] {
                                                       estimator.estimate(map, queries);
                                                       device.wait();
                                                   });
        const double peer = nanoflann_rate(points, asked, k);
        rows.push_back({fmt::format("{} nearest photons", k), n, seconds,
                        static_cast<double>(n) / seconds, "queries/s", 0,
                        peer > 0 ? nanoflann_name : "", peer});
    }
    return rows;
}

} // namespace argand
