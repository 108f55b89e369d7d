#include "nanoflann_peer.hpp"

#ifdef ARGAND_HAVE_NANOFLANN

#include "bench.hpp"

#include <algorithm>
#include <atomic>
#include <nanoflann.hpp>
#include <thread>

namespace argand {

namespace {

struct Points {
    const std::vector<glm::vec3>& points;
    std::size_t kdtree_get_point_count() const { return points.size(); }
    float kdtree_get_pt(std::size_t i, std::size_t axis) const {
        return points[i][static_cast<int>(axis)];
    }
    template <class Box> bool kdtree_get_bbox(Box&) const { return false; }
};

using Tree = nanoflann::KDTreeSingleIndexAdaptor<nanoflann::L2_Simple_Adaptor<float, Points>,
                                                 Points, 3, std::uint32_t>;

} // namespace

double nanoflann_rate(const std::vector<glm::vec3>& points, const std::vector<glm::vec3>& queries,
                      std::uint32_t k) {
    constexpr std::size_t chunk = 256;
    const Points adaptor{points};
    const Tree tree(3, adaptor, nanoflann::KDTreeSingleIndexAdaptorParams(16));
    const double seconds = median_host_seconds(
        [] {},
        [&] {
            std::atomic<std::size_t> next = 0;
            const auto work = [&] {
                std::vector<std::uint32_t> indices(k);
                std::vector<float> distances(k);
                for (std::size_t first = next.fetch_add(chunk); first < queries.size();
                     first = next.fetch_add(chunk)) {
                    for (std::size_t i = first; i < std::min(queries.size(), first + chunk); ++i) {
                        tree.knnSearch(&queries[i].x, k, indices.data(), distances.data());
                    }
                }
            };
            std::vector<std::jthread> threads;
            for (unsigned thread = 0; thread < std::max(1u, std::thread::hardware_concurrency());
                 ++thread) {
                threads.emplace_back(work);
            }
        });
    return static_cast<double>(queries.size()) / seconds;
}

} // namespace argand

#else

namespace argand {

double nanoflann_rate(const std::vector<glm::vec3>&, const std::vector<glm::vec3>&, std::uint32_t) {
    return 0;
}

} // namespace argand

#endif
