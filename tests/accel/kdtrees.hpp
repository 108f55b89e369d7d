#pragma once

#include "accel/kdtree_host.hpp"

#include <algorithm>
#include <gtest/gtest.h>
#include <random>
#include <vector>

namespace argand::testing {

inline BoxRecord box_between(const glm::vec3& a, const glm::vec3& b) {
    const glm::vec3 low = glm::min(a, b);
    const glm::vec3 high = glm::max(a, b);
    return {low.x, low.y, low.z, 0, high.x, high.y, high.z, 0};
}

/// Boxes with sides of up to `size` with their lower corners in the unit cube.
inline std::vector<BoxRecord> scattered_boxes(std::size_t count, float size,
                                              std::uint32_t seed = 1) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<float> uniform(0, 1);
    const auto point = [&] { return glm::vec3(uniform(random), uniform(random), uniform(random)); };
    std::vector<BoxRecord> boxes;
    boxes.reserve(count);
    for (std::size_t i = 0; i < count; ++i) {
        const glm::vec3 low = point();
        boxes.push_back(box_between(low, low + size * point()));
    }
    return boxes;
}

/// Elements that are hard to part, and usual ones.
inline std::vector<BoxRecord> elements_of(const std::string& kind, std::size_t count) {
    std::vector<BoxRecord> boxes = scattered_boxes(count, 0.05f);
    std::mt19937 random(7);
    std::uniform_real_distribution<float> uniform(0, 1);
    for (std::size_t i = 0; i < count; ++i) {
        BoxRecord& b = boxes[i];
        if (kind == "points") {
            b = box_between({b.low_x, b.low_y, b.low_z}, {b.low_x, b.low_y, b.low_z});
        } else if (kind == "one point") {
            b = box_between({3, 4, 5}, {3, 4, 5});
        } else if (kind == "two points") {
            const glm::vec3 p = i % 3 == 0 ? glm::vec3(-1, 2, 0) : glm::vec3(-1, 2, 1e-6f);
            b = box_between(p, p);
        } else if (kind == "lattice") {
            const glm::vec3 p(float(i % 7), float(i / 7 % 7), float(i / 49));
            b = box_between(p, p);
        } else if (kind == "coplanar") {
            b.low_y = b.high_y = 0;
        } else if (kind == "slivers") {
            const float y = uniform(random);
            b = box_between({0, y, uniform(random)}, {1, y, uniform(random)});
        } else if (kind == "overlapping") {
            b = box_between({-1 - uniform(random), -1, -1}, {1, 1 + uniform(random), 1});
        } else if (kind == "far apart") {
            const float x = std::ldexp(1.0f, static_cast<int>(i % 120));
            b = box_between({x, 0, 0}, {x, 0, x});
        } else if (kind == "not finite" && i % 5 == 0) {
            b.low_y = std::numeric_limits<float>::quiet_NaN();
            b.high_x = std::numeric_limits<float>::infinity();
        }
    }
    return boxes;
}

inline const std::vector<std::string>& kinds_of_elements() {
    static const std::vector<std::string> kinds{
        "boxes",    "points",  "one point",   "two points", "lattice",
        "coplanar", "slivers", "overlapping", "far apart",  "not finite"};
    return kinds;
}

} // namespace argand::testing
