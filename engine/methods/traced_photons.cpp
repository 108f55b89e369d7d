#include "methods/traced_photons.hpp"

#include "methods/photons_in_view.hpp"
#include "shared/photon.h"
#include "shared/random.h"

#include <algorithm>

namespace argand {

namespace {

// Units of the fixed-point flux sums in the mean flux of a photon.
constexpr double units_per_photon = 1 << 18;

/// Records from all over the slots of a pass, in this many runs: its bounces follow one another
/// there.
std::vector<PhotonRecord> some_photons(Device& device, const Buffer& photons, std::uint64_t slots,
                                       std::uint64_t runs, std::uint64_t in_run) {
    if (slots <= runs * in_run) {
        return download<PhotonRecord>(device, photons, slots);
    }
    std::vector<PhotonRecord> found;
    found.reserve(runs * in_run);
    for (std::uint64_t i = 0; i < runs; ++i) {
        const std::vector<PhotonRecord> run =
            download<PhotonRecord>(device, photons, in_run, (slots - in_run) * i / (runs - 1));
        found.insert(found.end(), run.begin(), run.end());
    }
    return found;
}

/// Sums over photons.
struct FluxMoments {
    double count = 0, flux = 0, squares = 0;
};

FluxMoments operator+(const FluxMoments& a, const FluxMoments& b) {
    return {a.count + b.count, a.flux + b.flux, a.squares + b.squares};
}

double evenness_of(const FluxMoments& m) {
    constexpr double least = 1.0 / 64;
    return m.squares > 0 ? std::max(m.flux * m.flux / (m.count * m.squares), least) : 1;
}

} // namespace

std::uint32_t area_seed(const PassNumbers& numbers) {
    return pcg4d({numbers.seed, static_cast<std::uint32_t>(numbers.index), 0xa4ea5u, 0}).x;
}

double flux_unit_for(const DeviceScene& scene, std::uint64_t photons) {
    const auto& power = scene.light_table.power;
    const double most = std::max({power.r, power.g, power.b});
    return (most > 0 ? most : 1) / static_cast<double>(std::max<std::uint64_t>(photons, 1)) /
           units_per_photon;
}

FluxSums flux_of(const std::vector<std::int64_t>& words, double unit) {
    FluxSums sums;
    for (std::size_t channel = 0; channel < 3; ++channel) {
        sums.emitted[channel] = words[channel];
        sums.absorbed[channel] = words[3 + channel];
        sums.escaped[channel] = words[6 + channel];
        sums.cut[channel] = words[9 + channel];
        sums.lost[channel] = words[12 + channel];
    }
    sums.unit = unit;
    return sums;
}

Evenness evenness_in_view(RenderContext& c, const PhotonWorkspace& workspace,
                          const StoredPhotons& stored) {
    const SceneRecord& scene = c.on_device.record;
    if (!(scene.view_share > 0)) {
        return {};
    }
    const Camera& camera = c.scene.cameras[c.settings.camera];
    const bool perspective = camera.kind == CameraKind::perspective;
    FluxMoments caustics, others;
    for (const PhotonRecord& photon :
         some_photons(c.device, workspace.photons, stored.slots, 64, 4096)) {
        if (photon.normal == no_photon) {
            continue;
        }
        const glm::vec3 place(photon.x, photon.y, photon.z);
        const glm::vec3 normal = unpack_photon_normal(photon.normal);
        const glm::vec3 to_eye = perspective ? camera.position - place : -camera.forward;
        const bool in_view = glm::distance(place, glm::vec3(scene.view)) < scene.view.w &&
                             glm::dot(normal, to_eye) > 0;
        if (in_view) {
            const double flux = double(photon.flux_r) + photon.flux_g + photon.flux_b;
            FluxMoments& of_kind = photon_is_caustic(photon.normal) ? caustics : others;
            of_kind = of_kind + FluxMoments{1, flux, flux * flux};
        }
    }
    return {.all = evenness_of(caustics + others),
            .caustics = evenness_of(caustics),
            .others = evenness_of(others)};
}

double in_view_per_emitted(RenderContext& c, const PhotonWorkspace& workspace,
                           const StoredPhotons& stored, std::span<const glm::vec4> queries) {
    if (stored.emitted == 0) {
        return 0;
    }
    const double share = share_in_view(
        some_photons(c.device, workspace.photons, stored.slots, 16, 512), queries,
        c.scene.cameras[c.settings.camera], double(c.settings.width) / c.settings.height);
    return share * static_cast<double>(stored.photons) / static_cast<double>(stored.emitted);
}

} // namespace argand
