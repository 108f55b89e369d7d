#include "scene/solids.hpp"

#include "scene/moving_factors.hpp"

#include <algorithm>
#include <limits>
#include <tuple>

namespace argand {

namespace {

/// What the triangles of a material bound.
struct Body {
    std::uint32_t material = 0;
    Bounds box;
    double volume = 0; ///< below 0: its faces look inwards
    glm::dvec3 area_vector{0};
    double area = 0;
};

/// Whether a material transmits light, now or at another time.
bool may_transmit(const Scene& scene, std::uint32_t index) {
    const Material& m = scene.materials[index];
    const MovingMaterial* moving = moving_material(scene.motion, index);
    return !m.phong && !m.unlit && (m.transmission > 0 || (moving && moving->keys.transmission)) &&
           (m.metallic < 1 || (moving && moving->keys.metallic));
}

bool may_be_thick(const Scene& scene, std::uint32_t index) {
    const MovingMaterial* moving = moving_material(scene.motion, index);
    return scene.materials[index].thickness > 0 || (moving && moving->keys.thickness);
}

/// Calls `add` with the body and the corners of each triangle of one.
template <class Add>
void for_each_triangle(const Scene& scene, std::vector<Body>& bodies, const Add& add) {
    std::vector<Body*> of_material(scene.materials.size(), nullptr);
    for (Body& body : bodies) {
        of_material[body.material] = &body;
    }
    for (std::size_t i = 0; i < scene.triangles.size(); ++i) {
        if (Body* body = of_material[scene.triangle_material[i]]) {
            const glm::uvec3& corners = scene.triangles[i];
            add(*body, scene.positions[corners.x], scene.positions[corners.y],
                scene.positions[corners.z]);
        }
    }
}

/// The bodies of these materials.
template <class Wanted> std::vector<Body> find_bodies(const Scene& scene, const Wanted& wanted) {
    std::vector<Body> bodies;
    for (std::uint32_t i = 0; i < scene.materials.size(); ++i) {
        if (wanted(i)) {
            bodies.push_back({.material = i});
        }
    }
    if (bodies.empty()) {
        return bodies;
    }
    for_each_triangle(scene, bodies, [](Body& body, const auto&... corners) {
        for (const glm::vec3& corner : {corners...}) {
            body.box.low = glm::min(body.box.low, corner);
            body.box.high = glm::max(body.box.high, corner);
        }
    });
    for_each_triangle(scene, bodies, [](Body& body, glm::dvec3 a, glm::dvec3 b, glm::dvec3 c) {
        const glm::dvec3 origin(body.box.low); // near, so that little is rounded off
        body.volume += glm::dot(a - origin, glm::cross(b - origin, c - origin)) / 6;
        const glm::dvec3 twice = glm::cross(b - a, c - a);
        body.area_vector += twice / 2.0;
        body.area += glm::length(twice) / 2;
    });
    std::erase_if(bodies, [](const Body& body) { return !(body.area > 0); });
    return bodies;
}

/// Whether a body's faces look to all sides alike, as those of a closed surface do.
bool is_closed(const Body& body) { return glm::length(body.area_vector) < 0.01 * body.area; }

bool contains(const Bounds& outer, const Bounds& inner) {
    return glm::all(glm::lessThanEqual(outer.low, inner.low)) &&
           glm::all(glm::lessThanEqual(inner.high, outer.high));
}

bool overlap(const Bounds& a, const Bounds& b) {
    return glm::all(glm::lessThan(a.low, b.high)) && glm::all(glm::lessThan(b.low, a.high));
}

bool is_same_glass(const Material& a, const Material& b) {
    return a.ior == b.ior && a.absorption == b.absorption && a.dispersion == b.dispersion &&
           a.priority == b.priority;
}

/// The smallest body in which this one is a cavity; null: it is none.
const Body* body_around(const Scene& scene, const std::vector<Body>& bodies, const Body& cavity) {
    if (!(cavity.volume < 0) || !is_closed(cavity)) {
        return nullptr;
    }
    const Body* around = nullptr;
    for (const Body& body : bodies) {
        const bool fits =
            body.volume > 0 && contains(body.box, cavity.box) &&
            is_same_glass(scene.materials[body.material], scene.materials[cavity.material]);
        if (fits && (!around || body.volume < around->volume)) {
            around = &body;
        }
    }
    return around;
}

/// The materials of two of these whose boxes overlap; of any two if meshes move.
std::optional<std::pair<std::uint32_t, std::uint32_t>> overlapping(const Scene& scene,
                                                                   const std::vector<Body>& of) {
    const bool moves = !scene.motion.meshes.empty();
    for (std::size_t a = 0; a < of.size(); ++a) {
        for (std::size_t b = a + 1; b < of.size(); ++b) {
            if (moves || overlap(of[a].box, of[b].box)) {
                return std::minmax(of[a].material, of[b].material);
            }
        }
    }
    return std::nullopt;
}

} // namespace

SolidRanks solid_ranks(const Scene& scene) {
    const std::vector<Body> bodies = find_bodies(scene, [&](std::uint32_t material) {
        return may_transmit(scene, material) && may_be_thick(scene, material);
    });
    std::vector<Body> solids;
    std::copy_if(bodies.begin(), bodies.end(), std::back_inserter(solids),
                 [&](const Body& body) { return !body_around(scene, bodies, body); });
    // An open surface is that of something large, as a sea.
    const auto rank = [&](const Body& body) {
        const double volume =
            is_closed(body) ? std::abs(body.volume) : std::numeric_limits<double>::infinity();
        return std::tuple(scene.materials[body.material].priority, -volume, body.material);
    };
    std::sort(solids.begin(), solids.end(),
              [&](const Body& a, const Body& b) { return rank(a) < rank(b); });
    SolidRanks ranks;
    ranks.of_material.resize(scene.materials.size(), 0);
    for (const Body& solid : solids) {
        ranks.materials.push_back(solid.material);
        ranks.of_material[solid.material] = static_cast<std::uint32_t>(ranks.materials.size());
    }
    for (const Body& body : bodies) {
        if (const Body* around = body_around(scene, bodies, body)) {
            ranks.of_material[body.material] = ranks.of_material[around->material];
        }
    }
    ranks.overlapping = overlapping(scene, solids);
    return ranks;
}

SolidRanks known_solid_ranks(const Scene& scene) {
    const bool known = scene.solids && scene.solids->of_material.size() == scene.materials.size();
    return known ? *scene.solids : solid_ranks(scene);
}

std::vector<std::uint32_t> thin_bodies(const Scene& scene) {
    std::vector<std::uint32_t> found;
    for (const Body& body : find_bodies(scene, [&](std::uint32_t material) {
             return may_transmit(scene, material) && !may_be_thick(scene, material);
         })) {
        if (is_closed(body) && body.volume > 0) {
            found.push_back(body.material);
        }
    }
    return found;
}

} // namespace argand
