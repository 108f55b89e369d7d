#include "methods/queue_photons.hpp"

#include "base/error.hpp"
#include "methods/photon_numbers.hpp"

#include <algorithm>
#include <cmath>

namespace argand {

std::uint64_t QueuePhotons::all() const {
    // Without bounces no photon is ever looked up.
    return c_.settings.bounces > 0 || options_.direct
               ? (c_.settings.photons + passes_ - 1) / passes_
               : 0;
}

std::uint64_t QueuePhotons::of(std::uint32_t block) const {
    const std::uint64_t window = options_.window;
    return all() * (block + 1ull) / window - all() * block / window;
}

void QueuePhotons::make_room() {
    // Rays that find covered areas go through the same slots: few would take many dispatches.
    constexpr std::uint64_t least_room = 1 << 14;
    const std::uint64_t most = max_photons_per_pass(c_.device);
    const std::uint64_t room = std::max(of(options_.window - 1), std::min(least_room, most));
    const bool keeps_lights = lights() > 1;
    if (room_ == room && workspace_.keeps_lights == keeps_lights) {
        return;
    }
    if (room > most) {
        fail("rendering '{}': '{}' cannot trace {} photons at once, as many as a frame has; use "
             "fewer photons or a larger window",
             c_.scene.name, c_.device.info().name, room);
    }
    const Buffer sums = workspace_.flux_sums;
    workspace_ = PhotonWorkspace(); // frees the old one's memory before the new one takes its own
    workspace_ = make_photon_workspace(
        c_.device, room,
        {.extents = extents_of(c_.on_device.plan), .lights = keeps_lights, .paths = keeps_paths()});
    workspace_.numbers = kind_of_photon_numbers(c_.settings);
    workspace_.reemission = c_.settings.footprints.paper_reemission ? REEMIT_PAPER : REEMIT_COSINE;
    if (sums) {
        workspace_.flux_sums = sums;
    }
    room_ = room;
}

StoredPhotons QueuePhotons::trace(const PassNumbers& numbers, std::uint64_t first,
                                  std::uint64_t count, std::uint64_t spread, double flux_unit) {
    const bool light = c_.on_device.record.light_count > 0;
    const PhotonPass emission{.seed = numbers.seed,
                              .first = all() * numbers.index + first,
                              .count = light ? count : 0,
                              .bounces = c_.settings.bounces,
                              .spread = spread,
                              .first_hits = options_.direct};
    const std::optional<StoredPhotons> stored =
        trace_photons(c_.device, c_.on_device, workspace_, emission, static_cast<float>(flux_unit));
    if (!stored) {
        fail("rendering '{}': the photons that are stored exceed what '{}' can address; use fewer "
             "bounces or photons",
             c_.scene.name, c_.device.info().name);
    }
    return *stored;
}

std::uint32_t QueuePhotons::lights() const {
    // Of more lights none matters much by itself.
    constexpr std::size_t most_lights = 256;
    const LightTable& table = c_.on_device.light_table;
    const std::size_t lights = table.lights.size();
    const bool tells = !c_.scene.motion.lights.empty() && table.first_light.empty() && lights > 1 &&
                       lights <= most_lights;
    return tells ? static_cast<std::uint32_t>(lights) : 1;
}

std::vector<double> QueuePhotons::light_shares() const {
    const LightTable& table = c_.on_device.light_table;
    std::vector<double> shares(lights(), 1.0);
    for (std::size_t i = 0; shares.size() > 1 && i < shares.size(); ++i) {
        const std::uint32_t emitter = table.emitter[i];
        shares[i] =
            c_.on_device.photon_shares[emitter] * table.weights[i] / table.emitter_weights[emitter];
    }
    return shares;
}

Bandwidth for_all_photons(Bandwidth learnt, double whole, const RenderSettings& settings) {
    const auto scale = [&](std::uint32_t& k) {
        k = static_cast<std::uint32_t>(std::lround(whole * static_cast<double>(k)));
    };
    if (!settings.neighbours) {
        scale(learnt.neighbours);
    }
    if (!settings.caustic_neighbours) {
        scale(learnt.caustic_neighbours);
    }
    // Footprints of all photons are made as if one pass had traced them. Their size, which falls
    // by itself with the photons of a pass, was learnt for these photons in many passes.
    if (!settings.footprints.fixed_smoothing) {
        learnt.smoothing *= std::pow(whole, 1.0 / 6);
        learnt.caustic_smoothing *= std::pow(whole, 1.0 / 6);
    } else if (!settings.footprints.smoothing) {
        learnt.smoothing *= std::sqrt(whole);
    }
    return learnt;
}

} // namespace argand
