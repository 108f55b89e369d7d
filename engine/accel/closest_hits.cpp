#include "accel/closest_hits.hpp"

#include <numeric>

namespace argand {

std::vector<HitRecord> closest_hits(Device& device, const TriangleBvh& bvh,
                                    std::span<const RayRecord> rays) {
    if (rays.empty()) {
        return {};
    }
    std::vector<std::uint32_t> all(rays.size());
    std::iota(all.begin(), all.end(), 0u);
    Traversal traversal = make_traversal(device, rays.size());
    traversal.careful = true;
    const Buffer uploaded = upload<RayRecord>(device, "rays", rays);
    const Buffer active = upload(device, "indices of rays", all);
    const Buffer hits = device.allocate("hits", rays.size() * sizeof(HitRecord));
    trace_closest(device, bvh, traversal,
                  {.rays = uploaded, .active = active, .results = hits, .count = rays.size()});
    return download<HitRecord>(device, hits, rays.size());
}

} // namespace argand
