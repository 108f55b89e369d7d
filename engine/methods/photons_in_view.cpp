#include "methods/photons_in_view.hpp"

#include "shared/photon.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <vector>

namespace argand {

namespace {

/// Cells along each side of the picture, so that hardly any part of it is without a point.
std::size_t cells_for(std::size_t points) {
    constexpr double points_in_cell = 8, most = 16;
    return static_cast<std::size_t>(
        std::clamp(std::sqrt(static_cast<double>(points) / points_in_cell), 1.0, most));
}

struct InPicture {
    double x, y;  ///< from 0 to 1
    double depth; ///< along the camera's axis

    std::size_t cell(std::size_t side) const {
        const auto cells = static_cast<double>(side);
        return static_cast<std::size_t>(y * cells) * side + static_cast<std::size_t>(x * cells);
    }
};

std::optional<InPicture> in_picture(const glm::dvec3& point, const Camera& camera, double aspect) {
    const bool perspective = camera.kind == CameraKind::perspective;
    const glm::dvec3 to = point - glm::dvec3(camera.position);
    const double depth = glm::dot(to, glm::dvec3(camera.forward));
    const double half =
        perspective ? depth * std::tan(0.5 * camera.vertical_angle) : camera.vertical_extent;
    const double x = 0.5 + 0.5 * glm::dot(to, glm::dvec3(camera.right)) / (aspect * half),
                 y = 0.5 + 0.5 * glm::dot(to, glm::dvec3(camera.up)) / half;
    if (!(depth > 0 && x >= 0 && x < 1 && y >= 0 && y < 1)) {
        return std::nullopt;
    }
    return InPicture{x, y, depth};
}

} // namespace

std::vector<std::uint32_t> cells_in_view(std::span<const PhotonRecord> photons,
                                         std::span<const glm::vec4> queries, const Camera& camera,
                                         double aspect) {
    // The rest of a slanted surface in a cell may be this much deeper than the points there.
    constexpr double deeper = 1.02;
    const std::size_t side = cells_for(queries.size());
    std::vector<double> deepest(side * side, 0.0);
    for (const glm::vec4& query : queries) {
        if (const auto found = in_picture(glm::dvec3(query), camera, aspect)) {
            double& depth = deepest[found->cell(side)];
            depth = std::max(depth, found->depth);
        }
    }
    std::vector<std::uint32_t> cells(photons.size(), out_of_view);
    for (std::size_t i = 0; i < photons.size(); ++i) {
        const PhotonRecord& photon = photons[i];
        if (photon.normal == no_photon) {
            continue;
        }
        const glm::vec3 place(photon.x, photon.y, photon.z);
        const glm::vec3 to_eye =
            camera.kind == CameraKind::perspective ? camera.position - place : -camera.forward;
        const auto found = in_picture(glm::dvec3(place), camera, aspect);
        const bool is_seen = found && found->depth <= deeper * deepest[found->cell(side)] &&
                             glm::dot(unpack_photon_normal(photon.normal), to_eye) > 0;
        if (is_seen) {
            cells[i] = static_cast<std::uint32_t>(found->cell(side));
        }
    }
    return cells;
}

double share_in_view(std::span<const PhotonRecord> photons, std::span<const glm::vec4> queries,
                     const Camera& camera, double aspect) {
    const std::vector<std::uint32_t> cells = cells_in_view(photons, queries, camera, aspect);
    const auto count = std::count_if(photons.begin(), photons.end(),
                                     [](const PhotonRecord& p) { return p.normal != no_photon; });
    const auto hidden = std::count(cells.begin(), cells.end(), out_of_view);
    const auto in_view = static_cast<double>(cells.size()) - static_cast<double>(hidden);
    return count > 0 ? in_view / static_cast<double>(count) : 0;
}

} // namespace argand
