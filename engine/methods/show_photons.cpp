#include "methods/show_photons.hpp"

#include "accel/closest_hits.hpp"
#include "shared/camera.h"
#include "shared/geometry_records.h"
#include "shared/path_records.h"
#include "shared/photon.h"

#include <algorithm>
#include <cmath>
#include <glm/glm.hpp>
#include <limits>

namespace argand {

namespace {

/// A point as a camera sees it.
struct Projected {
    double x = 0, y = 0;    ///< in pixels from the top left corner
    double distance = -1;   ///< from where the ray through (x, y) starts; negative: behind it
    glm::dvec3 direction{}; ///< of this ray, unit
};

/// The inverse of pinhole_ray().
Projected project(const CameraRecord& c, const glm::dvec3& point) {
    const glm::dvec3 across(c.across_x, c.across_y, c.across_z);
    const glm::dvec3 down(c.down_x, c.down_y, c.down_z);
    const glm::dvec3 corner(c.forward_x, c.forward_y, c.forward_z);
    const glm::dvec3 to = point - glm::dvec3(c.origin_x, c.origin_y, c.origin_z);
    const glm::dvec3 axis = glm::cross(across, down);
    const double depth = glm::dot(to, axis) / glm::dot(corner, axis);
    // In the picture's plane, from its corner.
    const bool perspective = c.origin_share == 0;
    const glm::dvec3 in_picture =
        perspective ? to / std::max(depth, 1e-300) - corner : to - depth * corner;
    Projected p;
    p.x = glm::dot(in_picture, across) / glm::dot(across, across);
    p.y = glm::dot(in_picture, down) / glm::dot(down, down);
    const glm::dvec3 ray = perspective ? corner + in_picture : corner;
    p.direction = glm::normalize(ray);
    p.distance = depth > 0 ? depth * glm::length(ray) : -1;
    return p;
}

/// Distances of what is in the middles of the pixels, row by row.
std::vector<float> depths_of(RenderContext& c, int width, int height) {
    const CameraRecord& camera = c.eye.queries.view;
    std::vector<float> depths;
    const std::uint64_t pixels = std::uint64_t(width) * std::uint64_t(height);
    depths.reserve(pixels);
    std::vector<RayRecord> rays;
    while (depths.size() < pixels) {
        rays.clear();
        for (std::uint64_t i = depths.size(); i < pixels && rays.size() < c.eye.slots; ++i) {
            const std::uint64_t column = i % std::uint64_t(width), row = i / std::uint64_t(width);
            vec3 o, d;
            pinhole_ray(camera, static_cast<float>(column) + 0.5f, static_cast<float>(row) + 0.5f,
                        o, d);
            d = d / std::sqrt(dot3(d, d));
            rays.push_back({.origin_x = o.x,
                            .origin_y = o.y,
                            .origin_z = o.z,
                            .t_max = far_away,
                            .direction_x = d.x,
                            .direction_y = d.y,
                            .direction_z = d.z});
        }
        for (const HitRecord& hit :
             closest_hits(c.device, c.on_device.bvh, c.eye.traversal, rays)) {
            depths.push_back(hit.triangle == no_triangle ? std::numeric_limits<float>::infinity()
                                                         : hit.t);
        }
    }
    return depths;
}

void upload_film(Device& device, const Film& film, const std::vector<glm::vec3>& colors) {
    std::vector<FilmRecord> records(colors.size());
    for (std::size_t i = 0; i < colors.size(); ++i) {
        records[i].direct_r = colors[i].r;
        records[i].direct_g = colors[i].g;
        records[i].direct_b = colors[i].b;
        records[i].samples = 1;
    }
    for (std::size_t part = 0; part < film.parts.size(); ++part) {
        const std::size_t first = part * film.pixels_per_part;
        const std::size_t count =
            std::min<std::size_t>(film.pixels_per_part, records.size() - first);
        device.upload(film.parts[part], 0, std::as_bytes(std::span(records).subspan(first, count)));
    }
}

} // namespace

void draw_photons(RenderContext& c, const PhotonMap& map) {
    const Film& film = c.eye.film;
    const std::vector<float> depths = depths_of(c, film.width, film.height);
    std::vector<glm::vec3> colors(depths.size(), glm::vec3(0));
    const std::uint32_t count = download_word(c.device, map.counters, counter_stored);
    for (const PhotonRecord& photon : download<PhotonRecord>(c.device, map.photons, count)) {
        const glm::vec3 flux(photon.flux_r, photon.flux_g, photon.flux_b);
        const float most = std::max({flux.r, flux.g, flux.b});
        if ((photon.normal & area_sample_bit) != 0 || !(most > 0)) {
            continue;
        }
        const Projected p = project(c.eye.queries.view, glm::dvec3(photon.x, photon.y, photon.z));
        const bool inside =
            p.x >= 0 && p.x < double(film.width) && p.y >= 0 && p.y < double(film.height);
        const glm::dvec3 normal(unpack_photon_normal(photon.normal));
        if (!inside || !(p.distance > 0) || !(glm::dot(normal, p.direction) < 0)) {
            continue;
        }
        const std::size_t pixel = std::size_t(p.y) * std::size_t(film.width) + std::size_t(p.x);
        // What is in the middle of the pixel may be nearer than the photon is, if it is seen at an
        // angle.
        constexpr double slack = 1.02;
        if (p.distance <= slack * double(depths[pixel])) {
            colors[pixel] = glm::max(colors[pixel], flux / most);
        }
    }
    upload_film(c.device, film, colors);
}

} // namespace argand
