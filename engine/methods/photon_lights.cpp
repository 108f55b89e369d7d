#include "methods/photon_lights.hpp"

#include "methods/photons_in_view.hpp"
#include "methods/small_image.hpp"
#include "methods/traced_photons.hpp"
#include "photon/photon_map.hpp"
#include "shared/random.h"

#include <algorithm>
#include <cmath>

namespace argand {

namespace {

// A picture of few photons does not trace more of them to learn where they should go.
constexpr std::uint64_t most_for_lights = 1u << 15;

/// The first ray of the photon's path that ends at a vertex.
struct FirstRay {
    glm::vec3 origin{0}, hit{0};
};

FirstRay first_ray(std::span<const PathVertex> vertices, std::size_t last) {
    const auto place = [](const PathVertex& v) { return glm::vec3(v.x, v.y, v.z); };
    PathVertex hit = vertices[last], start = hit;
    while (start.previous != no_vertex) {
        hit = start;
        start = vertices[start.previous];
    }
    return {place(start), place(hit)};
}

} // namespace

// The plan has followed paths with --everything, too, which must not change the picture.
bool may_hide_lights(const DeviceScene& scene) { return scene.casters && !scene.casters->empty(); }

std::vector<FoundLight> find_lights_of_photons(RenderContext& c) {
    const std::uint64_t emitted_for_lights = std::min(most_for_lights, c.settings.photons);
    if (emitted_for_lights == 0) {
        return {};
    }
    const Camera& camera = c.scene.cameras[c.settings.camera];
    const std::vector<glm::vec4> queries =
        sample_queries(c.device, c.on_device, c.eye, c.settings, camera);
    // Other photons than those of the image, about which they decide.
    const std::uint32_t seed = pcg4d({c.settings.seed, 0x71a57u, 0, 0}).x;
    PhotonWorkspace workspace =
        make_photon_workspace(c.device, emitted_for_lights, {.lights = true, .paths = true});
    const std::optional<StoredPhotons> stored =
        trace_photons(c.device, c.on_device, workspace,
                      {.seed = seed, .count = emitted_for_lights, .bounces = c.settings.bounces},
                      static_cast<float>(flux_unit_for(c.on_device, emitted_for_lights)));
    std::vector<FoundLight> found;
    if (!stored || stored->slots == 0) {
        return found;
    }
    const auto photons = download<PhotonRecord>(c.device, workspace.photons, stored->slots);
    const auto lights = download<std::uint32_t>(c.device, workspace.lights, stored->slots);
    const auto vertices =
        download<PathVertex>(c.device, workspace.vertices, 2 * emitted_for_lights + stored->slots);
    const std::vector<std::uint32_t> cells =
        cells_in_view(photons, queries, camera, double(c.settings.width) / c.settings.height);
    for (std::size_t i = 0; i < photons.size(); ++i) {
        if (cells[i] == out_of_view) {
            continue;
        }
        const FirstRay ray = first_ray(vertices, 2 * emitted_for_lights + i);
        const double flux = double(photons[i].flux_r) + photons[i].flux_g + photons[i].flux_b;
        const glm::vec3 along = ray.hit - ray.origin;
        if (flux > 0 && std::isfinite(flux) && glm::length(along) > 0) {
            found.push_back({.light = lights[i],
                             .pixel = cells[i],
                             .indirect = true,
                             .radiance = flux,
                             .point = ray.hit,
                             .direction = glm::normalize(along)});
        }
    }
    return found;
}

} // namespace argand
