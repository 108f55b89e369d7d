#include "scene/key_frames.hpp"

#include <algorithm>

namespace argand {
namespace {

/// Where a time lies among the keys.
struct Place {
    std::size_t key = 0; ///< the last one at or before the time, or the first
    double share = 0;    ///< of the way to the next key, in [0, 1)
    double interval = 0; ///< seconds to the next key
};

Place place_of(const std::vector<double>& times, double seconds) {
    const auto after = std::upper_bound(times.begin(), times.end(), seconds);
    if (after == times.begin()) {
        return {};
    }
    const auto key = static_cast<std::size_t>(after - times.begin()) - 1;
    if (after == times.end()) {
        return {.key = key};
    }
    const double interval = *after - times[key];
    return {.key = key, .share = (seconds - times[key]) / interval, .interval = interval};
}

/// The first number of a key's value.
const double* value_of(const KeyFrames& keys, std::size_t key) {
    return keys.interpolation == Interpolation::cubic_spline
               ? &keys.values[(3 * key + 1) * keys.width]
               : &keys.values[key * keys.width];
}

glm::dquat quaternion(const double* v) {
    return glm::normalize(glm::dquat(v[3], v[0], v[1], v[2]));
}

} // namespace

std::vector<double> value_at(const KeyFrames& keys, double seconds) {
    const Place place = place_of(keys.times, seconds);
    const double* from = value_of(keys, place.key);
    std::vector<double> value(from, from + keys.width);
    if (!(place.share > 0) || keys.interpolation == Interpolation::step) {
        return value;
    }
    const double* to = value_of(keys, place.key + 1);
    const double t = place.share;
    if (keys.interpolation == Interpolation::linear) {
        for (std::size_t i = 0; i < keys.width; ++i) {
            value[i] += t * (to[i] - from[i]);
        }
        return value;
    }
    // Cubic Hermite spline.
    const double* leaving = from + keys.width;
    const double* arriving = to - keys.width;
    const double t2 = t * t;
    const double t3 = t2 * t;
    for (std::size_t i = 0; i < keys.width; ++i) {
        value[i] = (2 * t3 - 3 * t2 + 1) * from[i] +
                   place.interval * (t3 - 2 * t2 + t) * leaving[i] + (3 * t2 - 2 * t3) * to[i] +
                   place.interval * (t3 - t2) * arriving[i];
    }
    return value;
}

glm::dquat rotation_at(const KeyFrames& keys, double seconds) {
    if (keys.interpolation != Interpolation::linear) {
        return quaternion(value_at(keys, seconds).data());
    }
    const Place place = place_of(keys.times, seconds);
    const glm::dquat from = quaternion(value_of(keys, place.key));
    return place.share > 0
               ? glm::slerp(from, quaternion(value_of(keys, place.key + 1)), place.share)
               : from;
}

} // namespace argand
