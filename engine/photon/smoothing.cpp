#include "photon/smoothing.hpp"

#include "base/median.hpp"
#include "kernels/footprint_distances.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace argand {

namespace {

// Enough for a median within a few per cent.
constexpr std::size_t points_looked_at = 96;
// Rank, among the footprints looked at, of the distance that is measured.
constexpr double measured_rank = 16;
// Two rounds over more would exceed the iterations of an invocation on lavapipe.
constexpr double most_looked_at = 30'000;

} // namespace

double median_smoothing(Device& device, const SortedPhotons& sorted,
                        std::span<const glm::vec4> points, double on_point) {
    if (sorted.others == 0 || points.empty()) {
        return 0;
    }
    const StageScope stage(device, "learn bandwidth");
    std::vector<glm::vec4> some;
    const std::size_t step = std::max<std::size_t>(points.size() / points_looked_at, 1);
    some.reserve(points.size() / step + 1);
    for (std::size_t i = step / 2; i < points.size(); i += step) {
        some.push_back(points[i]);
    }
    const double rank = std::clamp(on_point, 1.0, double(sorted.others));
    const double stride = std::max(
        {std::floor(rank / measured_rank), std::ceil(sorted.others / most_looked_at), 1.0});
    const auto looked_at = static_cast<std::uint32_t>(std::ceil(sorted.others / stride));
    const Buffer distances = device.scratch("learnt distances", some.size() * sizeof(float));
    dispatch(
        device,
        kernels::footprint_distances{.photons = sorted.photons,
                                     .footprints = sorted.footprints,
                                     .points = upload(device, "learning points", some),
                                     .distances = distances,
                                     .params = {.points = static_cast<std::uint32_t>(some.size()),
                                                .rank = rank_among_every(stride, rank),
                                                .stride = static_cast<std::uint32_t>(stride),
                                                .footprints = looked_at}},
        some.size());
    const std::vector<float> found = download<float>(device, distances, some.size());
    return median({found.begin(), found.end()});
}

} // namespace argand
