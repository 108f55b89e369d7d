#pragma once

#include "methods/bandwidth.hpp"
#include "methods/method.hpp"

namespace argand {

/// What distinguishes photon-mapping methods: how they choose a bandwidth and estimate radiance.
/// photon_mapping.hpp has what they share.
class EstimationStrategy {
public:
    virtual ~EstimationStrategy() = default;

    /// The bandwidth of a picture, from its first pass. Values that the user has set are kept.
    virtual Bandwidth learn(const FirstPass& first, const RenderSettings& settings) const {
        return learn_radii(first, settings);
    }

    /// Whether photons may carry flux of very different size, as those aimed at what is in view do.
    virtual bool takes_uneven_photons() const { return true; }

    /// The typical radius of an estimate. Area samples are as dense, and cells of shared answers as
    /// large, as suits it.
    virtual double typical_radius(const Bandwidth& bandwidth) const {
        return bandwidth.radii.indirect;
    }

    /// Whether photons keep the sizes of splats, from which footprints() makes discs.
    virtual bool splats() const { return false; }

    /// Size of the photons' footprints in a map of `photons` emitted photons; none if the estimator
    /// uses points.
    virtual std::optional<FootprintScale> footprints(const Bandwidth&, const FootprintSettings&,
                                                     double /*photons*/, const SceneRecord&) const {
        return std::nullopt;
    }

    /// Whether estimates are divided by the share of their disc that lies on surfaces.
    virtual bool corrects_boundaries(const RenderSettings&) const { return true; }

    /// Whether the caustic part of the map is queried by itself. may_part: whether that is worth
    /// it.
    virtual bool parts_caustics(const Bandwidth& bandwidth, bool may_part) const = 0;

    /// Radius of the largest discs of caustics, where they differ from those of other light; else
    /// 0.
    virtual double caustic_discs(const Bandwidth&) const { return 0; }

    /// The estimator of one pass, which answers queries of the map. It refers to the context.
    virtual std::unique_ptr<PhotonEstimator>
    make(const RenderContext& context, const PhotonMap& map, const Bandwidth& bandwidth) const = 0;

    /// The estimator for queries of paths behind their first estimated vertices, as in a final
    /// gather; null: the same. Their errors are hidden by the noise of the directions, so it may
    /// be a cheaper one.
    virtual std::unique_ptr<PhotonEstimator> make_for_gathers(const RenderContext&,
                                                              const Bandwidth&) const {
        return nullptr;
    }
};

} // namespace argand
