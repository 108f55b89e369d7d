#include "bench_nearest.hpp"

#include "bench_queries.hpp"
#include "nanoflann_peer.hpp"
#include "photon/nearest.hpp"
#include "photon/radius.hpp"
#include "shared/photon.h"

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
    for (std::size_t i = 0; i < photons.size(); ++i) {
        const PhotonRecord& p = photons[i];
        points.emplace_back(p.x, p.y, p.z);
        if (i % 8 == 0) {
            records.push_back(bench_query(points.back(), unpack_photon_normal(p.normal)));
            asked.push_back(points.back());
        }
    }
    const std::uint64_t n = asked.size();
    const PhotonQueries queries = bench_queries(device, records);
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
