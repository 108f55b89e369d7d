#pragma once

#include "methods/render.hpp"
#include "photon/gather.hpp"
#include "shared/path_records.h"
#include "world/device_scene.hpp"

namespace argand {

/// Which queries of eye paths traced together take the same answer of the photon map: those in a
/// cell.
struct QuerySharing {
    double cell = 0; ///< edge of a cell at most, in the scene's units; 0: none
    bool pixel_sized =
        false; ///< no cell is larger than a pixel: the answer may change from one to the next
    bool caustics_apart =
        false; ///< the map's caustic part is asked apart, in cells no larger than a pixel,
    bool sharp_caustics = false; ///< or, as here, by every path
};

/// Device memory for eye paths that are traced together.
struct EyeWorkspace {
    std::uint64_t slots = 0;
    bool final_gather = false; ///< the photon map is asked one scattering later, but for caustics
    CameraRecord view{};       ///< the picture's; `camera` is the device's copy
    Buffer camera, rays, hits, paths, layers, active, next_active, alive, shadow_rays, shadows,
        occluded;
    Buffer queries, asks;      ///< of the photon map: QueryRecord per slot, flags of slots that ask
    Buffer chosen, asking;     ///< flags and slots of those that ask for others, too
    Buffer estimates, partial; ///< EstimateRecord and GatherRecord per slot
    Buffer sources;            ///< uint per slot: the slot whose answer is taken, or no_query
    Buffer cells, owners;      ///< hash table of cells that share answers, see query_cells.comp
    QuerySharing sharing;
    Buffer counts;
    Traversal traversal;
    std::vector<Buffer> film; ///< FilmRecord per pixel, as many to a buffer as a kernel can address
    std::uint64_t film_pixels = 0; ///< to a buffer
};

/// As far as the plan needs it.
EyeWorkspace make_eye_workspace(Device& device, const Plan& plan, const RenderSettings& settings,
                                const CameraRecord& camera);

/// Answers the queries of the so many slots in EyeWorkspace::asking (see query_target) from a part
/// of the map; counts those it could not finish in EyeWorkspace::traversal.unfinished.
using Gather = std::function<void(const Count& asking, std::uint32_t part)>;

/// What the gathers of photon/gather.hpp and nearest.hpp want to know of the workspace.
GatherTarget query_target(const EyeWorkspace& workspace, std::uint32_t part);

/// Traces paths for the samples [first, first + count) of every pixel and adds them to the film.
/// Without `gather` these are the paths of a path tracer; with it, light that estimated lobes
/// scatter more than once is left to the photon map. Calls `progress` with the share done; returns
/// false if that did.
bool trace_eye_paths(Device& device, const DeviceScene& scene, EyeWorkspace& workspace,
                     const RenderSettings& settings, std::uint32_t first_sample,
                     std::uint32_t samples, const Gather& gather, const OnProgress& progress);

/// Points at which eye paths of a small version of the picture would ask the photon map. Waits for
/// the device.
std::vector<glm::vec3> sample_queries(Device& device, const DeviceScene& scene,
                                      EyeWorkspace& workspace, const RenderSettings& settings,
                                      const Camera& camera);

/// The film's means as layers, and the counts that belong to them.
std::vector<Layer> resolve_film(Device& device, const EyeWorkspace& workspace,
                                const RenderSettings& settings, RenderStatistics& statistics);

} // namespace argand
