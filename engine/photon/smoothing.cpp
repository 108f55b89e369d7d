#include "photon/smoothing.hpp"

#include "shared/footprint.h"
#include "shared/photon.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace argand {

namespace {

// Enough for a median within a few per cent. The work is their product: every point is compared
// with every photon.
constexpr std::size_t points_looked_at = 96;
constexpr std::size_t photons_looked_at = 50'000;

struct Ellipse {
    glm::vec3 position, a, b, normal;
};

} // namespace

double median_smoothing(std::span<const PhotonRecord> photons, std::span<const glm::uvec4> offsets,
                        std::span<const glm::vec3> points, const FootprintScale& unit,
                        double on_point) {
    std::vector<Ellipse> ellipses;
    const std::size_t stride = std::max<std::size_t>(photons.size() / photons_looked_at, 1);
    for (std::size_t i = 0; i < photons.size(); i += stride) {
        const PhotonRecord& photon = photons[i];
        if (photon.normal == no_photon || photon_is_caustic(photon.normal)) {
            continue;
        }
        PhotonDifferential d = no_differential();
        d.dp_du = unpack_dual(offsets[i].x, offsets[i].y);
        d.dp_dv = unpack_dual(offsets[i].z, offsets[i].w);
        const vec3 normal = unpack_photon_normal(photon.normal);
        const FootprintDuals duals =
            footprint_duals(make_footprint(d, normal, false, unit), normal);
        ellipses.push_back({{photon.x, photon.y, photon.z}, duals.a, duals.b, normal});
    }
    if (ellipses.empty() || points.empty()) {
        return 0;
    }
    const double on_point_of_these = on_point / static_cast<double>(stride);
    const auto nth =
        std::min(static_cast<std::size_t>(std::max(on_point_of_these, 1.0)), ellipses.size()) - 1;
    std::vector<float> distances(ellipses.size());
    std::vector<float> smoothings;
    const std::size_t step = std::max<std::size_t>(points.size() / points_looked_at, 1);
    for (std::size_t i = step / 2; i < points.size(); i += step) {
        // Squared distances in units of a footprint of smoothing 1.
        std::transform(ellipses.begin(), ellipses.end(), distances.begin(), [&](const Ellipse& e) {
            const glm::vec3 offset = points[i] - e.position;
            const float x = glm::dot(e.a, offset);
            const float y = glm::dot(e.b, offset);
            const float height = glm::dot(e.normal, offset);
            const float off_plane = height * height * glm::length(glm::cross(e.a, e.b));
            return x * x + y * y + off_plane / (disc_half_height * disc_half_height);
        });
        const auto found = distances.begin() + static_cast<std::ptrdiff_t>(nth);
        std::nth_element(distances.begin(), found, distances.end());
        smoothings.push_back(std::sqrt(*found));
    }
    const auto middle = smoothings.begin() + static_cast<std::ptrdiff_t>(smoothings.size() / 2);
    std::nth_element(smoothings.begin(), middle, smoothings.end());
    return *middle;
}

} // namespace argand
