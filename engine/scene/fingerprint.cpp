#include "scene/fingerprint.hpp"

namespace argand {

std::uint64_t fingerprint(const Scene& scene, std::uint64_t before) {
    std::uint64_t hash = before;
    const auto add = [&](const auto& values) {
        hash = fingerprint(std::as_bytes(std::span(values)), hash);
    };
    add(scene.positions);
    add(scene.normals);
    add(scene.triangles);
    add(scene.triangle_material);
    return hash;
}

} // namespace argand
