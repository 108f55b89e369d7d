#pragma once

#include "methods/bandwidth.hpp"
#include "methods/method.hpp"
#include "methods/queue_options.hpp"
#include "photon/photon_map.hpp"

#include <cstdint>
#include <vector>

namespace argand {

/// Traces the photons of a photons queue, block by block.
class QueuePhotons {
public:
    /// passes: of an image, which share the photons of the settings.
    QueuePhotons(RenderContext& context, const QueueOptions& options, std::uint64_t passes)
        : c_(context), options_(options), passes_(passes) {}

    /// Photons in the queue once it is full, and of a block.
    std::uint64_t all() const;
    std::uint64_t of(std::uint32_t block) const;
    /// Photons that can be traced at once.
    std::uint64_t room() const { return room_; }

    /// Makes memory, and keeps the sums of flux. Throws Error if the device has too little.
    void make_room();

    /// Traces photons of the window's sequence, from number `first` on. It goes on with each pass
    /// of an image, and begins anew with each image. spread: PhotonPass::spread.
    StoredPhotons trace(const PassNumbers& numbers, std::uint64_t first, std::uint64_t count,
                        std::uint64_t spread, double flux_unit);

    /// Lights that photons tell apart, so that those of lights that stand still do not grow old
    /// with those of a light that moves; 1: they tell none apart.
    std::uint32_t lights() const;
    /// Whether the paths of photons are kept, because meshes may come into their way.
    bool keeps_paths() const { return options_.window > 1 && !c_.scene.motion.meshes.empty(); }
    /// The share of each of these lights among the photons that are emitted.
    std::vector<double> light_shares() const;

    PhotonWorkspace& workspace() { return workspace_; }
    const PhotonWorkspace& workspace() const { return workspace_; }

private:
    RenderContext& c_;
    QueueOptions options_;
    std::uint64_t passes_;
    PhotonWorkspace workspace_;
    std::uint64_t room_ = 0;
};

/// The bandwidth for a map of all photons of a queue, from that which was learnt for many passes of
/// a part of them. whole: all photons over those of the part.
Bandwidth for_all_photons(Bandwidth learnt, double whole, const RenderSettings& settings);

} // namespace argand
