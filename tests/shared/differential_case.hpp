// Random photon paths past mirrors and through glass, in the precision of the including file.
// Compares their differentials with photons traced beside them.
#pragma once

#include "shared/light_differential.h"
#include "shared/random.h"
#include "shared/surface.h"

#include <cmath>

ARGAND_SHARED_BEGIN
namespace paths {

/// How the photon is emitted.
enum class Start { point, spot, directional, triangle, sky, paper, cosine, independent };
constexpr int start_count = 8;
constexpr real photon_count = 10000;

struct Photon {
    vec3 position, direction;
};

struct Begin {
    Photon photon;
    PhotonDifferential differential;
};

inline vec3 signed_vector(uint seed, uint stream) {
    const glm::vec4 u = random4(41, seed, stream, 0);
    return real(2) * vec3(u.x, u.y, u.z) - vec3(1);
}

inline vec3 unit_vector(uint seed, uint stream) {
    const glm::vec4 u = random4(41, seed, stream, 1);
    return sample_sphere(vec2(u.x, u.y));
}

inline LightRecord some_light(Start start, uint seed) {
    LightRecord l{};
    const glm::vec3 at(signed_vector(seed, 1));
    const glm::vec3 axis(unit_vector(seed, 2));
    l.kind = start == Start::point         ? light_point
             : start == Start::spot        ? light_spot
             : start == Start::directional ? light_directional
             : start == Start::triangle    ? light_triangle
                                           : light_sky;
    l.x = at.x;
    l.y = at.y;
    l.z = at.z;
    l.r = l.g = l.b = 1;
    l.dx = axis.x;
    l.dy = axis.y;
    l.dz = axis.z;
    l.cos_inner = 0.9f;
    l.cos_outer = 0.6f;
    if (start == Start::triangle) {
        const glm::vec3 far(unit_vector(seed, 3));
        l.ex = far.x;
        l.ey = far.y;
        l.ez = far.z;
        l.triangle_and_sides = seed % 2;
    }
    return l;
}

inline Begin begin(Start start, uint seed) {
    const glm::vec4 u = random4(42, seed, 0, 0);
    Begin b;
    if (start < Start::paper) {
        const LightRecord l = some_light(start, seed);
        EmittedPhoton p;
        light_emit(l, all_light_kinds, {vec3(0), real(2)}, u, random4(42, seed, 0, 1), p);
        b.photon = {p.origin, p.direction};
        b.differential =
            light_differential(l, all_light_kinds, p, real(2), photon_count, photon_count);
        return b;
    }
    const Frame frame = make_frame(unit_vector(seed, 4));
    b.photon.position = signed_vector(seed, 5);
    b.photon.direction = to_world(frame, sample_cosine_hemisphere(vec2(u.x, u.y)));
    PhotonDifferential before = no_differential();
    const vec3 a = signed_vector(seed, 6) * real(0.02);
    const vec3 c = signed_vector(seed, 7) * real(0.02);
    before.dp_du = a - frame.z * dot3(a, frame.z);
    before.dp_dv = c - frame.z * dot3(c, frame.z);
    const uint mode = start == Start::paper    ? REEMIT_PAPER
                      : start == Start::cosine ? REEMIT_COSINE
                                               : REEMIT_INDEPENDENT;
    b.differential = reemitted_differential(before, frame, b.photon.direction, photon_count, mode);
    return b;
}

/// A triangle with smooth normals in the photon's path.
struct Wall {
    vec3 v0, v1, v2, n0, n1, n2;
    real eta; // index behind it over index in front; 0: a mirror
};

inline Wall wall_before(IN(Photon) p, uint seed, uint number) {
    const uint stream = 10 + 10 * number;
    const glm::vec4 u = random4(43, seed, number, 0);
    const vec3 center = p.position + p.direction * (real(0.5) + real(u.x));
    const vec3 normal = glm::normalize(unit_vector(seed, stream) * real(0.6) - p.direction);
    const Frame f = make_frame(normal);
    Wall w;
    w.v0 = center - f.x * real(0.9) - f.y * real(0.7);
    w.v1 = center + f.x * real(0.8) - f.y * real(0.6);
    w.v2 = center + f.x * real(0.1) + f.y * real(1.1);
    w.n0 = glm::normalize(normal + signed_vector(seed, stream + 1) * real(0.2));
    w.n1 = glm::normalize(normal + signed_vector(seed, stream + 2) * real(0.2));
    w.n2 = glm::normalize(normal + signed_vector(seed, stream + 3) * real(0.2));
    w.eta = u.y < 0.4f ? real(0) : u.y < 0.7f ? real(1.5) : real(1) / real(1.5);
    return w;
}

inline SmoothTriangle triangle_of(IN(Wall) w) { return {w.v0, w.v1, w.v2, w.n0, w.n1, w.n2}; }

struct WallHit {
    real t;
    vec2 weights;
    Surface surface;
};

inline WallHit hit_wall(IN(Photon) p, IN(Wall) w) {
    const vec3 n = cross3(w.v1 - w.v0, w.v2 - w.v0);
    WallHit h;
    h.t = dot3(w.v0 - p.position, n) / dot3(p.direction, n);
    const vec3 q = p.position + p.direction * h.t - w.v0;
    h.weights.x = dot3(cross3(q, w.v2 - w.v0), n) / dot3(n, n);
    h.weights.y = dot3(cross3(w.v1 - w.v0, q), n) / dot3(n, n);
    h.surface = make_surface(triangle_of(w), h.weights.x, h.weights.y, p.direction);
    return h;
}

/// Whether the wall refracts this photon. Under total reflection it acts as a mirror.
inline bool refracts(IN(Wall) w, vec3 direction, vec3 n) {
    const real cosine = -dot3(direction, n);
    return w.eta > real(0) && (w.eta - 1) * (w.eta + 1) + cosine * cosine > real(0);
}

inline Photon scattered(IN(WallHit) h, IN(Wall) w, vec3 direction) {
    const vec3 n = h.surface.shading_normal;
    const real cosine = -dot3(direction, n);
    Photon next;
    next.position = h.surface.position;
    next.direction = direction + n * (2 * cosine);
    if (refracts(w, direction, n)) {
        const real refracted = std::sqrt((w.eta - 1) * (w.eta + 1) + cosine * cosine) / w.eta;
        next.direction = glm::normalize((direction + n * cosine) / w.eta - n * refracted);
    }
    return next;
}

struct Path {
    PhotonDifferential differential; // at the end of the path
    vec3 neighbour;    // end of the neighbouring photon, relative to this photon's end
    real conditioning; // smallest cosine along the path, including refracted ones
    bool alike;        // the neighbour was reflected or refracted at the same walls
};

/// Traces photon `seed` past `walls` walls to a plane, and beside it the photon that is emitted a
/// `step` away in the two parameters.
inline Path trace(Start start, uint seed, uint walls, vec2 step) {
    const Begin b = begin(start, seed);
    Path path;
    path.differential = b.differential;
    path.conditioning = 1;
    path.alike = true;
    Photon here = b.photon;
    const PhotonDifferential& d = b.differential;
    Photon beside{here.position + d.dp_du * step.x + d.dp_dv * step.y,
                  glm::normalize(here.direction + d.dd_du * step.x + d.dd_dv * step.y)};
    for (uint i = 0;; ++i) {
        const Wall w = wall_before(here, seed, i);
        const WallHit h = hit_wall(here, w);
        const WallHit g = hit_wall(beside, w);
        transfer_differential(path.differential, here.direction, h.t, h.surface.geometric_normal);
        const vec3 n = h.surface.shading_normal;
        path.conditioning =
            std::min(path.conditioning, std::abs(dot3(here.direction, h.surface.geometric_normal)));
        if (i == walls) {
            path.neighbour = g.surface.position - h.surface.position;
            return path;
        }
        vec3 dn[2];
        for (int k = 0; k < 2; ++k) {
            dn[k] =
                shading_normal_change(triangle_of(w), h.weights, n,
                                      k == 0 ? path.differential.dp_du : path.differential.dp_dv);
        }
        path.alike = path.alike && refracts(w, here.direction, n) ==
                                       refracts(w, beside.direction, g.surface.shading_normal);
        const Photon next = scattered(h, w, here.direction);
        if (refracts(w, here.direction, n)) {
            refract_differential(path.differential, here.direction, {n, dn[0], dn[1]}, w.eta);
        } else {
            reflect_differential(path.differential, here.direction, {n, dn[0], dn[1]});
        }
        path.conditioning = std::min(path.conditioning, std::abs(dot3(next.direction, n)));
        path.conditioning = std::min(path.conditioning, std::abs(dot3(here.direction, n)));
        beside = scattered(g, w, beside.direction);
        here = next;
    }
}

} // namespace paths
ARGAND_SHARED_END
