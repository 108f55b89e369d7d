#pragma once

#include "bench_scene.hpp"

#include <memory>

namespace argand {

/// Embree on the same scene and rays, one ray at a time, on all of the machine's threads. Rates are
/// 0 if the build did not find Embree.
class EmbreePeer {
public:
    explicit EmbreePeer(const BenchScene& scene);
    ~EmbreePeer();
    EmbreePeer(const EmbreePeer&) = delete;
    EmbreePeer& operator=(const EmbreePeer&) = delete;

    static constexpr const char* closest_name = "Embree 3, rtcIntersect1";
    static constexpr const char* occluded_name = "Embree 3, rtcOccluded1";
    double closest_rate(const BenchRays& rays) const;
    double occluded_rate(const BenchRays& rays) const;

private:
    struct State;
    std::unique_ptr<State> state_;
};

} // namespace argand
