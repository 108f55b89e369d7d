#include "embree_peer.hpp"

#ifdef ARGAND_HAVE_EMBREE

#include "bench.hpp"

#include <algorithm>
#include <atomic>
#include <cstring>
#include <embree3/rtcore.h>
#include <thread>

namespace argand {

struct EmbreePeer::State {
    RTCDevice device = rtcNewDevice(nullptr);
    RTCScene scene = rtcNewScene(device);

    ~State() {
        rtcReleaseScene(scene);
        rtcReleaseDevice(device);
    }
};

EmbreePeer::EmbreePeer(const BenchScene& scene) : state_(std::make_unique<State>()) {
    const RTCGeometry geometry = rtcNewGeometry(state_->device, RTC_GEOMETRY_TYPE_TRIANGLE);
    auto* positions = static_cast<float*>(
        rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                3 * sizeof(float), scene.positions.size()));
    for (const glm::vec4& position : scene.positions) {
        std::memcpy(positions, &position, 3 * sizeof(float));
        positions += 3;
    }
    auto* indices = static_cast<std::uint32_t*>(
        rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                3 * sizeof(std::uint32_t), scene.triangles.size()));
    for (const glm::uvec4& triangle : scene.triangles) {
        std::memcpy(indices, &triangle, 3 * sizeof(std::uint32_t));
        indices += 3;
    }
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(state_->scene, geometry);
    rtcReleaseGeometry(geometry);
    rtcSetSceneFlags(state_->scene, RTC_SCENE_FLAG_ROBUST);
    rtcCommitScene(state_->scene);
}

namespace {

RTCRay make_ray(const BenchRays& rays, std::size_t i) {
    RTCRay ray{};
    ray.org_x = rays.origins[i].x;
    ray.org_y = rays.origins[i].y;
    ray.org_z = rays.origins[i].z;
    ray.dir_x = rays.directions[i].x;
    ray.dir_y = rays.directions[i].y;
    ray.dir_z = rays.directions[i].z;
    ray.tfar = rays.ends[i];
    ray.mask = 0xffffffffu;
    return ray;
}

/// Rays per second of trace(i) over all rays; threads take chunks dynamically.
template <class Function> double rate(std::size_t count, Function&& trace) {
    constexpr std::size_t chunk = 4096;
    const auto trace_all = [&] {
        std::atomic<std::size_t> next = 0;
        const auto work = [&] {
            for (std::size_t first = next.fetch_add(chunk); first < count;
                 first = next.fetch_add(chunk)) {
                for (std::size_t ray = first; ray < std::min(count, first + chunk); ++ray) {
                    trace(ray);
                }
            }
        };
        std::vector<std::jthread> threads;
        for (unsigned thread = 0; thread < std::max(1u, std::thread::hardware_concurrency());
             ++thread) {
            threads.emplace_back(work);
        }
    };
    return double(count) / median_host_seconds([] {}, trace_all);
}

} // namespace

EmbreePeer::~EmbreePeer() = default;

double EmbreePeer::closest_rate(const BenchRays& rays) const {
    std::vector<float> ends(rays.origins.size());
    return rate(ends.size(), [&](std::size_t i) {
        RTCIntersectContext context;
        rtcInitIntersectContext(&context);
        RTCRayHit hit{};
        hit.ray = make_ray(rays, i);
        hit.hit.geomID = RTC_INVALID_GEOMETRY_ID;
        rtcIntersect1(state_->scene, &context, &hit);
        ends[i] = hit.ray.tfar;
    });
}

double EmbreePeer::occluded_rate(const BenchRays& rays) const {
    std::vector<float> ends(rays.origins.size());
    return rate(ends.size(), [&](std::size_t i) {
        RTCIntersectContext context;
        rtcInitIntersectContext(&context);
        RTCRay ray = make_ray(rays, i);
        rtcOccluded1(state_->scene, &context, &ray);
        ends[i] = ray.tfar;
    });
}

} // namespace argand

#else

namespace argand {

struct EmbreePeer::State {};
EmbreePeer::EmbreePeer(const BenchScene&) {}
EmbreePeer::~EmbreePeer() = default;
double EmbreePeer::closest_rate(const BenchRays&) const { return 0; }
double EmbreePeer::occluded_rate(const BenchRays&) const { return 0; }

} // namespace argand

#endif
