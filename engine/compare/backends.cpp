#include "compare/backends.hpp"

#include "base/clock.hpp"
#include "base/error.hpp"
#include "compare/golden_device.hpp"
#include "compare/paired_device.hpp"
#include "image/metrics.hpp"
#include "scene/fingerprint.hpp"
#include "scene/pose.hpp"
#include "session/render.hpp"
#include "world/world.hpp"

#include <algorithm>
#include <array>
#include <string_view>

namespace argand {

namespace {

constexpr std::array<std::string_view, 25> exact_stages{
    sort_stage,          scan_stage,         segmented_scan_stage, reduce_stage,
    reduce_box_stage,    compact_stage,      "lbvh_codes",         "code_distances",
    "lbvh_fit",          "wide_roots",       "triangle_boxes",     "photon_codes",
    "photon_count",      "photon_leaves",    "photon_order",       "photon_tally",
    "query_owners",      "ray_refit",        "pose_boxes",         "segment_boxes",
    "segment_boxes_end", "partition_places", "expand_sources",     "frontier_count",
    "frontier_copy"};

RenderResult render_with(Device& device, const Scene& scene, const RenderSettings& settings,
                         MethodTable methods) {
    return render(
        device, scene, settings, [](double) { return true; }, nullptr, methods);
}

RenderResult render_timed(Device& device, const Scene& scene, const RenderSettings& settings,
                          MethodTable methods, double& seconds) {
    render_with(device, scene, settings, methods); // compiles the kernels
    const Clock::time_point start = Clock::now();
    RenderResult result = render_with(device, scene, settings, methods);
    seconds = seconds_since(start);
    return result;
}

/// Renders the scene and, if meshes move in it, another moment in the same world, which refits the
/// tree.
void render_moments(Device& device, const Scene& at_first, const RenderSettings& settings,
                    MethodTable methods) {
    Scene scene = at_first;
    World world(device, scene);
    Session session(world, scene, settings, methods);
    const auto render_moment = [&] {
        session.begin_frame(settings.seed);
        finish(session, [](double) { return true; });
    };
    render_moment();
    if (!scene.motion.meshes.empty()) {
        constexpr double share_of_animation = 0.4;
        move_without_vertices(share_of_animation * longest_animation(scene), scene);
        world.update(scene);
        render_moment();
    }
}

std::vector<StageComparison> compare_stages(Device& a, Device& b, const Scene& scene,
                                            const RenderSettings& settings, MethodTable methods,
                                            Pairing pairing) {
    PairedDevice pair(a, b, pairing);
    render_moments(pair, scene, settings, methods);
    return pair.comparisons();
}

} // namespace

BackendComparison compare_backends(Device& a, Device& b, const Scene& scene,
                                   const RenderSettings& settings, MethodTable methods) {
    BackendComparison result;
    const RenderResult image_a = render_timed(a, scene, settings, methods, result.seconds_a);
    const RenderResult image_b = render_timed(b, scene, settings, methods, result.seconds_b);
    result.rel_mse =
        compare(image_b.layers.front().image, image_a.layers.front().image, "B", "A").rel_mse;
    result.isolated = compare_stages(a, b, scene, settings, methods, Pairing::isolated);
    result.end_to_end = compare_stages(a, b, scene, settings, methods, Pairing::end_to_end);
    return result;
}

bool must_be_equal(const StageComparison& stage) {
    return std::find(exact_stages.begin(), exact_stages.end(), stage.name) != exact_stages.end();
}

namespace {

bool within(const StageComparison& stage, double tolerance) {
    return static_cast<double>(stage.diverged) <= tolerance * static_cast<double>(stage.items);
}

} // namespace

bool passes_isolated(const StageComparison& stage) {
    return must_be_equal(stage) ? stage.unequal == 0 : within(stage, isolated_tolerance);
}

bool passes_end_to_end(const StageComparison& stage) { return within(stage, end_to_end_tolerance); }

bool passes(const BackendComparison& comparison) {
    return comparison.rel_mse <= image_tolerance &&
           std::all_of(comparison.isolated.begin(), comparison.isolated.end(), passes_isolated) &&
           std::all_of(comparison.end_to_end.begin(), comparison.end_to_end.end(),
                       passes_end_to_end);
}

GoldenCapture record_golden(Device& device, const Scene& scene, const RenderSettings& settings,
                            MethodTable methods) {
    host::HostDevice other(host::describe());
    PairedDevice pair(device, other, Pairing::isolated);
    GoldenCapture capture;
    pair.record(capture);
    render_with(pair, scene, settings, methods);
    return capture;
}

RenderSettings settings_of(const Golden& golden, const std::string& method) {
    RenderSettings settings;
    settings.method = method;
    settings.width = golden.width;
    settings.height = golden.height;
    settings.samples = golden.samples;
    settings.photons = golden.photons;
    settings.seed = golden.seed;
    return settings;
}

std::vector<StageComparison> compare_with_golden(const Golden& golden, const std::string& method,
                                                 Device& device, const Scene& scene,
                                                 MethodTable methods) {
    const auto capture = golden.captures.find(method);
    if (capture == golden.captures.end()) {
        fail("comparing with a golden capture of '{}': it has none of method {}", golden.scene,
             method);
    }
    if (scene.name != golden.scene || fingerprint(scene) != golden.fingerprint) {
        fail("comparing '{}' with a golden capture: it was recorded from another version of '{}'; "
             "compare with that scene, or record it anew",
             scene.name, golden.scene);
    }
    GoldenDevice recorded(golden, capture->second);
    PairedDevice pair(recorded, device, Pairing::isolated);
    render_with(pair, scene, settings_of(golden, method), methods);
    recorded.expect_end();
    return pair.comparisons();
}

} // namespace argand
