#pragma once

#include "accel/lbvh.hpp"
#include "photon/area_tree.hpp"
#include "photon/frontier_settings.hpp"
#include "shared/differential.h"
#include "shared/footprint_records.h"
#include "shared/photon_records.h"
#include "shared/sampling.h"
#include "shared/view_points.h"
#include "world/device_scene.hpp"

#include <algorithm>
#include <array>
#include <functional>
#include <optional>

namespace argand {

/// Tells a kernel in which part of the scene estimates are corrected.
template <class Params> void set_corrected_part(Params& params, const SampledPart& part) {
    constexpr double largest = 1e18; // its square is finite
    params.corrected_x = part.center.x;
    params.corrected_y = part.center.y;
    params.corrected_z = part.center.z;
    params.corrected_distance = static_cast<float>(std::min(part.reach, largest));
}

/// Photons in the order of a space-filling curve, and a hierarchy over blocks of them. A map owns
/// its buffers: it stays as it is when the workspace traces other photons or builds another map.
struct PhotonMap {
    Buffer counters;                ///< counter_* of shared/photon_records.h
    Buffer photons;                 ///< PhotonRecord: photons and area samples
    Lbvh lbvh;                      ///< over the photons, in their order, some to a leaf
    std::uint32_t area_samples = 0; ///< among the photons
    SampledPart corrected;          ///< in which area samples surround every query
    AreaTree areas;    ///< over the area samples; only where caustics have discs or footprints that
                       ///< hold some
    Buffer footprints; ///< uvec4 per photon: dual axes (pack_dual of
                       ///< shared/footprint.h); empty: none
    float flatness = 1;          ///< of the footprints
    double mean_footprints = 0;  ///< summed area of all footprints over that of the surfaces
    std::uint32_t leaf_size = 0; ///< photons in a leaf at most
    /// How queries are answered together; none: each by itself, through the tree. Maps that have
    /// this have no tree, and without footprints their photons are in no order.
    std::optional<FrontierSettings> frontier;
};

/// Which photons a pass emits, and how far they go.
struct PhotonPass {
    std::uint32_t seed = 0;
    std::uint64_t first = 0;   ///< number of the pass's first photon in the whole picture
    std::uint64_t count = 0;   ///< photons emitted; they share each light's power
    std::uint32_t bounces = 0; ///< scatterings at most of a stored photon
    /// Photons of all passes whose photons are in one map, for their spacing; 0: `count`.
    std::uint64_t spread = 0;
    bool first_hits = false; ///< photons are stored where they are scattered first, too, so that
                             ///< they account for direct light
};

/// The photons that a pass has stored.
struct StoredPhotons {
    std::uint64_t slots = 0;   ///< records in use, some of them empty
    std::uint64_t photons = 0; ///< records that hold a photon
    std::uint64_t emitted = 0;
    std::uint64_t near = 0; ///< photons from nearby surfaces, stored or not
};

/// Finds the hits of photons' rays, as trace_closest() does. The results hold the hits that the
/// rays leave, and start_of_path as t where they leave lights.
using PhotonTracer = std::function<void(const RayBatch& batch)>;

/// Told of the hits of a batch's active photons, before they scatter there.
using OnPhotonHits = std::function<void(const PhotonBatch& batch, const Count& active)>;

/// Sums of PhotonWorkspace::flux_sums: those of a FluxLedger, of three channels.
inline constexpr std::size_t flux_words = 15;

/// Device memory for tracing photons and for building maps; grows with need.
struct PhotonWorkspace {
    std::uint64_t slots = 0;                  ///< photons traced together
    std::uint64_t capacity = 0;               ///< photons stored
    std::uint32_t extents = extents_none;     ///< extents_* of shared/photon_records.h
    std::uint32_t numbers = numbers_sobol;    ///< numbers_* of shared/sampling.h
    std::uint32_t reemission = REEMIT_COSINE; ///< REEMIT_* of shared/differential.h
    Buffer rays, hits, paths, ledgers, active, next_active, alive, counters, photons, codes, order,
        heads;
    Buffer differentials; ///< DifferentialRecord per slot
    Buffer offsets;       ///< uvec4 per stored photon: its positional differentials, or its splat's
                          ///< size, pack_dual of shared/footprint.h
    bool stores = true;   ///< whether photons are stored at estimated lobes
    bool keeps_lights = false;    ///< whether photons keep the indices of their lights
    Buffer path_lights;           ///< uint per slot: the photon's light
    Buffer lights;                ///< uint per stored photon: its light
    bool keeps_paths = false;     ///< whether the vertices of photons' paths are kept
    std::uint64_t most_paths = 0; ///< photons of a pass whose paths are kept
    Buffer path_vertices;         ///< uint per slot: the last vertex of the photon's path
    Buffer vertices;              ///< PathVertex: 2 per photon of the pass, and 1 per stored photon
    Buffer flux_sums; ///< flux_words sums of 64 bits: emitted, absorbed, escaped, cut and lost,
                      ///< of three channels each
    Traversal traversal;
    PhotonTracer tracer;                 ///< none: rays go through the scene's tree
    Buffer last_sorted, last_footprints; ///< of the map that was built last: the next map takes
                                         ///< this memory if nobody holds that map any more
};

/// What is kept of photons.
struct KeptOfPhotons {
    std::uint32_t extents = extents_none; ///< extents_* of shared/photon_records.h
    bool lights = false;                  ///< PhotonWorkspace::keeps_lights
    bool paths = false;                   ///< PhotonWorkspace::keeps_paths
    bool stores = true;                   ///< PhotonWorkspace::stores
};

PhotonWorkspace make_photon_workspace(Device& device, std::uint64_t photons_per_pass,
                                      const KeptOfPhotons& kept = {});

/// What photons need for footprints if the plan has them.
std::uint32_t extents_of(const Plan& plan);

/// The most photons that a map may hold on this device.
std::uint64_t max_stored_photons(const Device& device);

/// The most photons that one pass should emit if they are stored as often as usual.
std::uint64_t max_photons_per_pass(const Device& device);

/// Emits photons from every light in proportion to its power, traces them, and stores them at
/// estimated lobes from the second hit on. Waits for the device. Adds flux to the workspace's sums
/// in units of `flux_unit`. Returns nothing if the stored photons exceed the device's storage
/// range: emit fewer in a pass. on_hits: told of every batch's hits; of a batch that is traced
/// again (Traversal::careful) twice.
std::optional<StoredPhotons> trace_photons(Device& device, const DeviceScene& scene,
                                           PhotonWorkspace& workspace, const PhotonPass& pass,
                                           float flux_unit, const OnPhotonHits& on_hits = {});

/// Points in view, to which places nearby must be linked (covered.hpp).
struct ViewPoints {
    Buffer table;    ///< ViewPointRecord per entry of a hash table of cells
    Buffer near;     ///< filter of the cells around these; no point is near a place elsewhere
    Buffer unlinked; ///< filter of the cells in which some area of the last map was not linked
    double cell = 0; ///< edge of a cell
};

struct PhotonMapSettings {
    std::uint64_t area_samples = 0;   ///< wanted; the map has none if there is no room for them
    double cover_height = 0;          ///< of surfaces that cover photons and areas (covered.hpp)
    bool drops_covered = false;       ///< covered photons are not in the map
    const ViewPoints* view = nullptr; ///< with drops_covered: nor are photons and areas that are
                                      ///< not linked to these
    std::uint32_t seed = 0;           ///< of the area samples
    std::uint32_t leaf_size = 0; ///< photons in a leaf at most, up to most_photons_a_leaf; 0: 16
    bool wide_codes = false;     ///< 63-bit Morton codes, for photons that lie in a few places
                                 ///< far from each other
    std::optional<FootprintScale> footprints; ///< leaves' boxes bound footprints of this scale;
                                              ///< none: they bound points
    bool uniform_kernel = false;              ///< of the footprints, instead of Epanechnikov's
    double caustic_radius = 0; ///< of the largest discs of caustics that are corrected apart from
                               ///< those of other light; 0: there are none
    std::optional<FrontierSettings> frontier; ///< the map is one without a tree, whose queries are
                                              ///< answered together
};

/// Appends samples of the surfaces' area to the stored photons of the workspace, which grows for
/// them, in the place of any that a map has added. Returns their number. Records only.
std::uint32_t append_area_samples(Device& device, const DeviceScene& scene,
                                  PhotonWorkspace& workspace, const StoredPhotons& stored,
                                  const PhotonMapSettings& settings);

/// Area samples of a map over the area [length²] on which they lie.
double samples_per_area(const DeviceScene& scene, std::uint32_t area_samples);

/// How footprints of this scale are made.
FootprintParams footprint_params(const DeviceScene& scene, const FootprintScale& scale,
                                 std::uint32_t area_samples);

/// Computes the footprints of the records that lie in workspace.order, and in this order in
/// map.photons. Waits for the device.
void make_footprints(Device& device, const DeviceScene& scene, PhotonWorkspace& workspace,
                     const FootprintScale& scale, PhotonMap& map);

/// Builds the map over the stored photons and over samples of the surfaces' area, which tell a
/// query how much of its disc lies on surfaces. Waits for the device.
PhotonMap build_photon_map(Device& device, const DeviceScene& scene, PhotonWorkspace& workspace,
                           const StoredPhotons& stored, const PhotonMapSettings& settings = {});

} // namespace argand
