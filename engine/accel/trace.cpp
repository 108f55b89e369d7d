#include "accel/triangle_bvh.hpp"

#include "kernels/kd_any.hpp"
#include "kernels/kd_any_alpha.hpp"
#include "kernels/kd_closest.hpp"
#include "kernels/kd_closest_alpha.hpp"
#include "kernels/trace_any.hpp"
#include "kernels/trace_any_alpha.hpp"
#include "kernels/trace_any_alpha_texels.hpp"
#include "kernels/trace_any_texels.hpp"
#include "kernels/trace_closest.hpp"
#include "kernels/trace_closest_alpha.hpp"
#include "kernels/trace_closest_alpha_texels.hpp"
#include "kernels/trace_closest_texels.hpp"
#include "parallel/parts.hpp"
#include "shared/accel_records.h"
#include "shared/kdtree.h"

#include <algorithm>

namespace argand {

namespace {

constexpr std::uint64_t max_slots = 4096;

struct Work {
    Device& device;
    const TriangleBvh& bvh;
    const Traversal& traversal;
    const RayBatch& batch;
};

using RunKernel = void (*)(const Work& work, const TraceParams& params, bool resume,
                           std::uint64_t threads);

template <class Kernel>
void dispatch_rays(const Work& work, const Kernel& kernel, const TraceParams& params, bool resume,
                   std::uint64_t threads) {
    if (!resume && params.count.on_device != 0) {
        dispatch_indirect(work.device, kernel, work.batch.count.buffer, work.batch.count.index);
    } else {
        dispatch(work.device, kernel, threads);
    }
}

/// The buffers that all kernels share which trace rays through the four-wide tree.
kernels::TraverseBindings tree_of(const Work& work) {
    return {.nodes = work.bvh.nodes,
            .triangles = work.bvh.triangles,
            .rays = work.batch.rays,
            .active_rays = work.batch.active,
            .counts = counts_or(work.batch.count, work.batch.active),
            .suspended = work.traversal.suspended,
            .unfinished = work.traversal.unfinished};
}

/// The same for a kd-tree.
kernels::KdRayBindings kdtree_of(const Work& work) {
    return {.words = work.bvh.kdtree.words,
            .boxes = work.bvh.kdtree.boxes,
            .triangles = work.bvh.triangles,
            .rays = work.batch.rays,
            .active_rays = work.batch.active,
            .counts = counts_or(work.batch.count, work.batch.active),
            .suspended = work.traversal.suspended,
            .unfinished = work.traversal.unfinished};
}

/// Dispatches one of the kernels that trace rays. Its output is the only member behind the buffers
/// that all of them share: `hits` or `occluded`.
template <class Kernel, auto tree>
void run(const Work& work, const TraceParams& params, bool resume, std::uint64_t threads) {
    const Kernel kernel{tree(work), work.batch.results, params, {.resume = resume}};
    dispatch_rays(work, kernel, params, resume, threads);
}

/// The same with a kernel for surfaces with alpha.
template <class Kernel, auto tree>
void run_alpha(const Work& work, const TraceParams& params, bool resume, std::uint64_t threads) {
    const AlphaSurfaces& alpha = *work.bvh.alpha;
    const Kernel kernel{
        tree(work),
        work.batch.results,
        {.scene = alpha.scene,
         .corners = alpha.triangles,
         .materials = alpha.materials,
         .attributes = alpha.attributes,
         .textures = alpha.textures,
         .texels = alpha.texels},
        params,
        {.resume = resume,
         .alpha = {.textured = alpha.textured, .vertex_colors = alpha.vertex_colors}}};
    dispatch_rays(work, kernel, params, resume, threads);
}

bool has_kdtree(const TriangleBvh& bvh) { return static_cast<bool>(bvh.kdtree.words); }

bool reads_texels(Device& device, const TriangleBvh& bvh) {
    return read_as_texels(device, bvh.nodes, bvh.triangles);
}

TraceParams make_params(const Work& work) {
    const auto& [device, bvh, traversal, batch] = work;
    TraceParams params{.count = count_record(batch.count),
                       .first = 0,
                       .root = bvh.triangle_count == 0   ? lbvh_end
                               : bvh.triangle_count == 1 ? 1u
                                                         : 0u,
                       .step_limit = traversal.step_limit,
                       .slot_count = traversal.slots,
                       .last = 0};
    if (has_kdtree(bvh)) {
        params.root = bvh.triangle_count == 0 ? lbvh_end : 0u;
        const std::uint64_t room = traversal.suspended.size() / sizeof(std::uint32_t);
        params.slot_count = static_cast<std::uint32_t>(std::min<std::uint64_t>(
            traversal.slots, (room - suspended_head) / kd_suspended_stride));
    }
    return params;
}

/// Boxes and triangles that a ray visits at most: no node twice.
std::uint64_t most_steps(const TriangleBvh& bvh) {
    return has_kdtree(bvh) ? 2 * std::uint64_t(bvh.kdtree.leaf_count) + bvh.kdtree.references
                           : 2ull * bvh.triangle_count;
}

/// Records the dispatch of all rays, and one that resumes the suspended ones.
void record(const Work& work, RunKernel run_kernel) {
    TraceParams params = make_params(work);
    // A ray cannot use up its steps in a small tree, unless it begins anew behind a surface.
    const bool begins_anew = has_kdtree(work.bvh) && work.bvh.alpha.has_value();
    const bool may_suspend = begins_anew || most_steps(work.bvh) > params.step_limit;
    if (may_suspend) {
        work.device.fill(
            BufferView(work.traversal.suspended, 0, suspended_head * sizeof(std::uint32_t)), 0);
    }
    run_kernel(work, params, false, work.batch.count.bound);
    if (may_suspend) {
        params.last = 1;
        run_kernel(work, params, true, params.slot_count);
    }
}

/// Traces as many rays at a time as there are slots, and resumes them until all are done.
void run_to_the_end(const Work& work, RunKernel run_kernel) {
    TraceParams params = make_params(work);
    std::uint64_t count = work.batch.count.bound;
    if (work.batch.count.on_device()) {
        count = std::min<std::uint64_t>(
            count, download_word(work.device, work.batch.count.buffer, work.batch.count.index));
    }
    params.count.on_device = 0;
    for (std::uint64_t first = 0; first < count; first += params.slot_count) {
        params.first = static_cast<std::uint32_t>(first);
        params.count.number =
            static_cast<std::uint32_t>(std::min(count, first + params.slot_count));
        work.device.fill(
            BufferView(work.traversal.suspended, 0, suspended_head * sizeof(std::uint32_t)), 0);
        run_kernel(work, params, false, params.count.number - params.first);
        while (download_word(work.device, work.traversal.suspended, 1) > 0) {
            work.device.fill(
                BufferView(work.traversal.suspended, sizeof(std::uint32_t), sizeof(std::uint32_t)),
                0);
            run_kernel(work, params, true, params.slot_count);
        }
    }
}

void trace(const Work& work, RunKernel run_kernel) {
    if (work.traversal.careful) {
        run_to_the_end(work, run_kernel);
    } else {
        record(work, run_kernel);
    }
}

/// The kernel for the tree: of kd-trees, else the one that reads nodes as texels where that is
/// faster.
RunKernel choose(Device& device, const TriangleBvh& bvh, RunKernel kdtree, RunKernel texels,
                 RunKernel plain) {
    return has_kdtree(bvh) ? kdtree : reads_texels(device, bvh) ? texels : plain;
}

} // namespace

Traversal make_traversal(Device& device, std::uint64_t max_rays) {
    Traversal traversal;
    const std::uint64_t range = device.info().limits.storage_range / sizeof(std::uint32_t);
    const std::uint64_t most =
        std::min<std::uint64_t>(max_slots, (range - suspended_head) / suspended_stride);
    traversal.slots = static_cast<std::uint32_t>(std::clamp<std::uint64_t>(max_rays, 1, most));
    traversal.unfinished = device.allocate("unfinished rays", sizeof(std::uint32_t));
    // Room for one ray on its way through a kd-tree, at least.
    const std::uint64_t words = std::max<std::uint64_t>(
        std::uint64_t(traversal.slots) * suspended_stride, kd_suspended_stride);
    traversal.suspended =
        device.allocate("suspended rays", (suspended_head + words) * sizeof(std::uint32_t));
    return traversal;
}

void trace_closest(Device& device, const TriangleBvh& bvh, Traversal& traversal,
                   const RayBatch& batch) {
    trace({device, bvh, traversal, batch},
          bvh.alpha ? choose(device, bvh, run_alpha<kernels::kd_closest_alpha, kdtree_of>,
                             run_alpha<kernels::trace_closest_alpha_texels, tree_of>,
                             run_alpha<kernels::trace_closest_alpha, tree_of>)
                    : choose(device, bvh, run<kernels::kd_closest, kdtree_of>,
                             run<kernels::trace_closest_texels, tree_of>,
                             run<kernels::trace_closest, tree_of>));
}

void trace_any(Device& device, const TriangleBvh& bvh, Traversal& traversal,
               const RayBatch& batch) {
    trace({device, bvh, traversal, batch},
          bvh.alpha
              ? choose(device, bvh, run_alpha<kernels::kd_any_alpha, kdtree_of>,
                       run_alpha<kernels::trace_any_alpha_texels, tree_of>,
                       run_alpha<kernels::trace_any_alpha, tree_of>)
              : choose(device, bvh, run<kernels::kd_any, kdtree_of>,
                       run<kernels::trace_any_texels, tree_of>, run<kernels::trace_any, tree_of>));
}

} // namespace argand
