#include "accel/triangle_bvh.hpp"

#include "kernels/trace_any.hpp"
#include "kernels/trace_any_texels.hpp"
#include "kernels/trace_closest.hpp"
#include "kernels/trace_closest_texels.hpp"
#include "parallel/parts.hpp"
#include "shared/accel_records.h"

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

/// Dispatches one of the kernels that trace rays. Its output is the only member behind the buffers
/// that all of them share: `hits` or `occluded`.
template <class Kernel>
void run(const Work& work, const TraceParams& params, bool resume, std::uint64_t threads) {
    const Kernel kernel{{.nodes = work.bvh.nodes,
                         .triangles = work.bvh.triangles,
                         .rays = work.batch.rays,
                         .active_rays = work.batch.active,
                         .counts = counts_or(work.batch.count, work.batch.active),
                         .suspended = work.traversal.suspended,
                         .unfinished = work.traversal.unfinished},
                        work.batch.results,
                        params,
                        {.resume = resume}};
    if (!resume && params.count.on_device != 0) {
        dispatch_indirect(work.device, kernel, work.batch.count.buffer, work.batch.count.index);
    } else {
        dispatch(work.device, kernel, threads);
    }
}

TraceParams make_params(const Work& work) {
    return {.count = count_record(work.batch.count),
            .first = 0,
            .root = work.bvh.triangle_count == 0   ? lbvh_end
                    : work.bvh.triangle_count == 1 ? 1u
                                                   : 0u,
            .step_limit = work.traversal.step_limit,
            .slot_count = work.traversal.slots,
            .last = 0};
}

/// Records the dispatch of all rays, and one that resumes the suspended ones.
void record(const Work& work, RunKernel run_kernel) {
    TraceParams params = make_params(work);
    // A ray visits no node twice, so it cannot use up its steps in a small tree.
    const bool may_suspend = 2ull * work.bvh.triangle_count > params.step_limit;
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

} // namespace

Traversal make_traversal(Device& device, std::uint64_t max_rays) {
    Traversal traversal;
    const std::uint64_t range = device.info().limits.storage_range / sizeof(std::uint32_t);
    const std::uint64_t most =
        std::min<std::uint64_t>(max_slots, (range - suspended_head) / suspended_stride);
    traversal.slots = static_cast<std::uint32_t>(std::clamp<std::uint64_t>(max_rays, 1, most));
    traversal.unfinished = device.allocate("unfinished rays", sizeof(std::uint32_t));
    traversal.suspended = device.allocate(
        "suspended rays", (suspended_head + std::uint64_t(traversal.slots) * suspended_stride) *
                              sizeof(std::uint32_t));
    return traversal;
}

void trace_closest(Device& device, const TriangleBvh& bvh, Traversal& traversal,
                   const RayBatch& batch) {
    trace({device, bvh, traversal, batch}, read_as_texels(device, bvh.nodes, bvh.triangles)
                                               ? run<kernels::trace_closest_texels>
                                               : run<kernels::trace_closest>);
}

void trace_any(Device& device, const TriangleBvh& bvh, Traversal& traversal,
               const RayBatch& batch) {
    trace({device, bvh, traversal, batch}, read_as_texels(device, bvh.nodes, bvh.triangles)
                                               ? run<kernels::trace_any_texels>
                                               : run<kernels::trace_any>);
}

} // namespace argand
