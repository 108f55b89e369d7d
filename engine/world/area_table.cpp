#include "world/area_table.hpp"

#include "base/hash_floats.hpp"
#include "scene/material_record.hpp"
#include "shared/follow.h"
#include "shared/morton.h"
#include "shared/triangle_piece.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <unordered_set>

namespace argand {

namespace {

using Corners = std::array<float, 9>;

/// A piece of a triangle in the table.
struct Piece {
    std::uint32_t triangle, number; ///< see shared/triangle_piece.h
    double area;
    std::uint32_t code; ///< along the space-filling curve
};

/// Divides triangles, and keeps the pieces that lie in the sampled part.
class Pieces {
public:
    Pieces(const PlacedScene& placed, const SampledPart& part)
        : placed_(placed), part_(part), box_(bounds(placed)) {}

    void add(std::uint32_t triangle, double area) {
        const glm::uvec3& t = placed_.scene.triangles[triangle];
        corners_ = {placed_.positions[t.x], placed_.positions[t.y], placed_.positions[t.z]};
        add({triangle, whole_triangle, area, 0}, triangle_piece(whole_triangle));
    }

    std::vector<Piece> all;

private:
    glm::vec3 at(const vec2& b) const {
        return corners_[0] + (corners_[1] - corners_[0]) * b.x + (corners_[2] - corners_[0]) * b.y;
    }

    void add(Piece piece, const TrianglePiece& place) {
        const glm::vec3 a = at(place.a);
        const glm::vec3 b = at(place.b);
        const glm::vec3 c = at(place.c);
        const glm::vec3 middle = (a + b + c) / 3.0f;
        const double radius = std::max(
            {glm::distance(middle, a), glm::distance(middle, b), glm::distance(middle, c)});
        const double distance = glm::distance(middle, part_.center);
        if (distance - radius > part_.reach) {
            return;
        }
        const bool crosses = distance + radius > part_.reach && 8 * radius > part_.reach;
        if (!crosses || piece.number >= smallest_piece) {
            piece.code = morton30(middle, box_.low, box_.high);
            all.push_back(piece);
            return;
        }
        for (std::uint32_t k = 0; k < 4; ++k) {
            add({piece.triangle, 4 * piece.number + k, piece.area / 4, 0}, part_of_piece(place, k));
        }
    }

    const PlacedScene& placed_;
    const SampledPart& part_;
    Bounds box_;
    std::array<glm::vec3, 3> corners_{};
};

} // namespace

std::vector<double> areas_for_photons(const PlacedScene& placed, float follow_roughness) {
    const Scene& scene = placed.scene;
    std::vector<bool> stores;
    for (const Material& material : scene.materials) {
        stores.push_back(estimated_lobes(material_record(material), follow_roughness) != 0);
    }
    std::vector<double> areas;
    areas.reserve(scene.triangles.size());
    std::unordered_set<Corners, HashFloats> there;
    there.reserve(scene.triangles.size());
    for (std::size_t i = 0; i < scene.triangles.size(); ++i) {
        const glm::uvec3& t = scene.triangles[i];
        std::array<std::array<float, 3>, 3> v;
        for (int k = 0; k < 3; ++k) {
            const glm::vec3& p = placed.positions[t[k]];
            v[static_cast<std::size_t>(k)] = {p.x, p.y, p.z};
        }
        std::rotate(v.begin(), std::min_element(v.begin(), v.end()), v.end());
        const bool is_new = there.insert(std::bit_cast<Corners>(v)).second;
        areas.push_back(is_new && stores[scene.triangle_material[i]] ? area(placed, i) : 0);
    }
    return areas;
}

AreaTable make_area_table(const PlacedScene& placed, const std::vector<double>& areas,
                          const SampledPart& part) {
    Pieces pieces(placed, part);
    for (std::uint32_t i = 0; i < areas.size(); ++i) {
        if (areas[i] > 0) {
            pieces.add(i, areas[i]);
        }
    }
    std::stable_sort(pieces.all.begin(), pieces.all.end(),
                     [](const Piece& a, const Piece& b) { return a.code < b.code; });
    AreaTable table;
    for (const Piece& piece : pieces.all) {
        table.area += piece.area;
    }
    table.sums.reserve(pieces.all.size());
    const double scale = 4294967296.0 / std::max(table.area, 1e-30);
    double sum = 0;
    for (const Piece& piece : pieces.all) {
        table.sums.push_back({static_cast<std::uint32_t>(std::min(sum * scale, 4294967295.0)),
                              piece.triangle, piece.number});
        sum += piece.area;
    }
    return table;
}

} // namespace argand
