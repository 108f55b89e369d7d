#include "accel/closest_hits.hpp"

#include <numeric>

namespace argand {

std::vector<HitRecord> closest_hits(Device& device, const TriangleBvh& bvh, Traversal traversal,
                                    std::span<const RayRecord> rays) {
    if (rays.empty()) {
        return {};
    }
    std::vector<std::uint32_t> all(rays.size());
    std::iota(all.begin(), all.end(), 0u);
    const Buffer uploaded = device.scratch("closest hits: rays", rays.size_bytes());
    const Buffer active = device.scratch("closest hits: indices of rays", all.size() * 4);
    const Buffer hits = device.scratch("closest hits", rays.size() * sizeof(HitRecord));
    device.upload(uploaded, 0, std::as_bytes(rays));
    device.upload(active, 0, std::as_bytes(std::span(all)));
    traversal.careful = true;
    trace_closest(device, bvh, traversal,
                  {.rays = uploaded, .active = active, .results = hits, .count = rays.size()});
    return download<HitRecord>(device, hits, rays.size());
}

} // namespace argand
