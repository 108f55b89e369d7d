#include "scene/solids.hpp"

#include <algorithm>
#include <tuple>

namespace argand {

namespace {

struct Solid {
    std::uint32_t material = 0;
    Bounds box;
    double volume = 0; ///< below 0: its faces look inwards
};

/// Whether a material bounds a solid, now or at another time: textures and motion may change how
/// much of it is clear, but not the rest.
bool may_bound_solid(const Material& m) { return m.thickness > 0 && !m.phong && !m.unlit; }

/// The material's solid among these; null: it bounds none.
std::vector<Solid*> by_material(const Scene& scene, std::vector<Solid>& solids) {
    std::vector<Solid*> result(scene.materials.size(), nullptr);
    for (Solid& solid : solids) {
        result[solid.material] = &solid;
    }
    return result;
}

/// Calls `add` with the solid and the corners of each triangle that bounds one.
template <class Add>
void for_each_triangle(const Scene& scene, std::vector<Solid>& solids, const Add& add) {
    const std::vector<Solid*> of_material = by_material(scene, solids);
    for (std::size_t i = 0; i < scene.triangles.size(); ++i) {
        if (Solid* solid = of_material[scene.triangle_material[i]]) {
            const glm::uvec3& corners = scene.triangles[i];
            add(*solid, scene.positions[corners.x], scene.positions[corners.y],
                scene.positions[corners.z]);
        }
    }
}

/// What the triangles of each of these materials bound.
template <class Wanted> std::vector<Solid> find_bodies(const Scene& scene, const Wanted& wanted) {
    std::vector<Solid> solids;
    for (std::uint32_t i = 0; i < scene.materials.size(); ++i) {
        if (wanted(scene.materials[i])) {
            solids.push_back({.material = i});
        }
    }
    if (solids.empty()) {
        return solids;
    }
    for_each_triangle(scene, solids, [](Solid& solid, const auto&... corners) {
        for (const glm::vec3& corner : {corners...}) {
            solid.box.low = glm::min(solid.box.low, corner);
            solid.box.high = glm::max(solid.box.high, corner);
        }
    });
    // Seen from the box's middle, an open surface bounds little.
    for_each_triangle(scene, solids, [](Solid& solid, glm::dvec3 a, glm::dvec3 b, glm::dvec3 c) {
        const glm::dvec3 middle = (glm::dvec3(solid.box.low) + glm::dvec3(solid.box.high)) * 0.5;
        solid.volume += glm::dot(a - middle, glm::cross(b - middle, c - middle)) / 6;
    });
    std::erase_if(solids, [](const Solid& solid) { return solid.box.low.x > solid.box.high.x; });
    return solids;
}

std::vector<Solid> find_solids(const Scene& scene) { return find_bodies(scene, may_bound_solid); }

bool contains(const Bounds& outer, const Bounds& inner) {
    return glm::all(glm::lessThanEqual(outer.low, inner.low)) &&
           glm::all(glm::lessThanEqual(inner.high, outer.high));
}

bool overlap(const Bounds& a, const Bounds& b) {
    return glm::all(glm::lessThan(a.low, b.high)) && glm::all(glm::lessThan(b.low, a.high));
}

bool same_glass(const Material& a, const Material& b) {
    return a.ior == b.ior && a.absorption == b.absorption && a.dispersion == b.dispersion &&
           a.priority == b.priority;
}

/// The smallest solid in which this one is a cavity; null: it is none.
const Solid* around_cavity(const Scene& scene, const std::vector<Solid>& solids,
                           const Solid& cavity) {
    const Solid* around = nullptr;
    for (const Solid& solid : solids) {
        const bool fits =
            cavity.volume < 0 && solid.volume > 0 && contains(solid.box, cavity.box) &&
            same_glass(scene.materials[solid.material], scene.materials[cavity.material]);
        if (fits && (!around || solid.volume < around->volume)) {
            around = &solid;
        }
    }
    return around;
}

/// The solids but for cavities of others.
std::vector<Solid> without_cavities(const Scene& scene, const std::vector<Solid>& solids) {
    std::vector<Solid> bodies;
    std::copy_if(solids.begin(), solids.end(), std::back_inserter(bodies),
                 [&](const Solid& solid) { return !around_cavity(scene, solids, solid); });
    return bodies;
}

} // namespace

SolidRanks solid_ranks(const Scene& scene) {
    const std::vector<Solid> solids = find_solids(scene);
    std::vector<Solid> bodies = without_cavities(scene, solids);
    const auto rank = [&](const Solid& s) {
        return std::tuple(scene.materials[s.material].priority, -std::abs(s.volume), s.material);
    };
    std::sort(bodies.begin(), bodies.end(),
              [&](const Solid& a, const Solid& b) { return rank(a) < rank(b); });
    SolidRanks ranks;
    ranks.of_material.resize(scene.materials.size(), 0);
    for (const Solid& body : bodies) {
        ranks.materials.push_back(body.material);
        ranks.of_material[body.material] = static_cast<std::uint32_t>(ranks.materials.size());
    }
    for (const Solid& solid : solids) {
        if (const Solid* around = around_cavity(scene, solids, solid)) {
            ranks.of_material[solid.material] = ranks.of_material[around->material];
        }
    }
    return ranks;
}

std::optional<std::pair<std::uint32_t, std::uint32_t>> overlapping_solids(const Scene& scene) {
    const std::vector<Solid> solids = without_cavities(scene, find_solids(scene));
    const bool moves = !scene.motion.meshes.empty();
    for (std::size_t a = 0; a < solids.size(); ++a) {
        for (std::size_t b = a + 1; b < solids.size(); ++b) {
            if (moves || overlap(solids[a].box, solids[b].box)) {
                return std::pair(solids[a].material, solids[b].material);
            }
        }
    }
    return std::nullopt;
}

std::vector<std::uint32_t> thin_bodies(const Scene& scene) {
    // An open surface bounds some volume too, seen from the middle of its box, but seldom as much.
    constexpr double least_filled = 0.2;
    std::vector<std::uint32_t> found;
    for (const Solid& body : find_bodies(scene, [](const Material& m) {
             return m.transmission > 0 && m.thickness <= 0 && m.metallic < 1 && !m.phong &&
                    !m.unlit;
         })) {
        const glm::dvec3 size = glm::dvec3(body.box.high) - glm::dvec3(body.box.low);
        if (body.volume > least_filled * size.x * size.y * size.z) {
            found.push_back(body.material);
        }
    }
    return found;
}

} // namespace argand
