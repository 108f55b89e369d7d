#pragma once

#include "shared/numbers.hpp"
#include "truth.hpp"

#include <algorithm>
#include <cmath>
#include <glm/glm.hpp>
#include <random>

namespace argand::testing {

/// Inputs of the functions under test: random ones and, in a quarter of the cases, extremes.
struct Draw {
    std::mt19937 bits;
    truth::Inputs x{};
    int next = 0;

    explicit Draw(unsigned seed) : bits(seed) {}

    bool once_in(unsigned n) { return bits() % n == 0; }
    double between(double low, double high) {
        return std::uniform_real_distribution<double>(low, high)(bits);
    }
    float sign() { return once_in(2) ? 1.0f : -1.0f; }
    float magnitude(int low, int high) { return any_magnitude(bits, low, high); }

    void put(float value) { x[static_cast<std::size_t>(next++)] = value; }
    void put(glm::vec3 v) {
        put(v.x);
        put(v.y);
        put(v.z);
    }
    /// As two halves of 16 bits.
    void put_word(std::uint32_t word) {
        put(static_cast<float>(word >> 16));
        put(static_cast<float>(word & 0xffff));
    }

    /// A number as the renderer's random streams produce it: a multiple of 2^-24 in [0, 1), often
    /// 0, the largest, or the middle.
    float unit() {
        const float ends[] = {0, 0x1p-24f, 0.25f, 0.5f, 0.5f - 0x1p-24f, 1 - 0x1p-24f};
        return once_in(8) ? ends[bits() % 6] : static_cast<float>(bits() >> 8) * 0x1p-24f;
    }
    /// In [0, 1], including tiny numbers and both ends.
    float share() {
        switch (bits() % 6) {
        case 0:
            return static_cast<float>(bits() % 2);
        case 1:
            return magnitude(-30, 0);
        default:
            return unit();
        }
    }
    /// Of either sign; one in eight is 0.
    float component(int low, int high) { return once_in(8) ? 0 : sign() * magnitude(low, high); }
    glm::vec3 vector(int low, int high) {
        return {component(low, high), component(low, high), component(low, high)};
    }
    glm::vec3 nonzero_vector(int low, int high) {
        glm::vec3 v = vector(low, high);
        v[static_cast<int>(bits() % 3)] = sign() * magnitude(low, high);
        return v;
    }

    /// A direction; includes axes, diagonals, and directions near an axis or a plane.
    glm::vec3 direction() {
        std::normal_distribution<double> normal;
        glm::dvec3 v(normal(bits), normal(bits), normal(bits));
        switch (bits() % 8) {
        case 0: { // an axis
            glm::vec3 axis(0);
            axis[static_cast<int>(bits() % 3)] = sign();
            return axis;
        }
        case 1: // near an axis
            v = glm::dvec3(vector(-26, -4));
            v[static_cast<int>(bits() % 3)] = sign();
            break;
        case 2: // near a plane
            v[static_cast<int>(bits() % 3)] *= magnitude(-26, 0);
            break;
        default:
            break;
        }
        return rounded(glm::normalize(v));
    }
    /// A direction above the surface; includes the normal and cosines down to 10^-7.
    glm::vec3 upper() {
        glm::dvec3 v(direction());
        v.z = std::abs(v.z);
        if (once_in(4)) {
            v.z *= magnitude(-24, 0);
        }
        v.z = std::max(v.z, 1e-7);
        return rounded(glm::normalize(v));
    }
    /// A unit vector perpendicular to n, up to rounding.
    glm::dvec3 across(glm::dvec3 n) {
        const glm::dvec3 other = std::abs(n.x) < 0.6 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0);
        const glm::dvec3 u = glm::normalize(glm::cross(n, other));
        const glm::dvec3 v = glm::cross(n, u);
        const double angle = between(0, 6.283185307179586);
        return u * std::cos(angle) + v * std::sin(angle);
    }
    /// On n's side, with a cosine of at least 10^-7.
    glm::vec3 above(glm::vec3 n) {
        const double cosine = once_in(3) ? double(magnitude(-23, 0)) : between(0.01, 1);
        const glm::dvec3 z(n);
        return rounded(
            glm::normalize(z * cosine + across(z) * std::sqrt(std::max(1 - cosine * cosine, 0.0))));
    }
    /// Index ratios of dielectric interfaces: 0.1 to 10, including 1 ± 10^-7.
    float index_ratio() {
        const float ends[] = {0.1f, 1 - 0x1p-23f, 1 - 0x1p-24f, 1, 1 + 0x1p-23f, 1.0001f, 10};
        return once_in(3) ? ends[bits() % 7] : static_cast<float>(std::pow(10.0, between(-1, 1)));
    }
};

} // namespace argand::testing
