#include "scene/environment.hpp"

#include "base/error.hpp"
#include "base/fingerprint.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>
#include <utility>

namespace argand {

namespace {

using std::numbers::pi;

/// sin² of half the angle from +Y of the lower border of so many rows.
double share_above(double rows, int height) {
    const double sine = std::sin(0.5 * pi * rows / height);
    return sine * sine;
}

/// The share of all directions for which a row of texels stands: radiance is linear between rows,
/// so half of the solid angle between two rows counts for either.
double share_of_row(int row, int height) {
    const auto middle = [&](int of_row) { return share_above(of_row + 0.5, height); };
    const double above = row == 0 ? 0 : 0.5 * (middle(row - 1) + middle(row));
    const double below = row == height - 1 ? 1 : 0.5 * (middle(row) + middle(row + 1));
    return below - above;
}

glm::dvec3 mean_of(const SkyPicture& picture) {
    glm::dvec3 mean(0);
    const auto width = static_cast<std::size_t>(picture.width);
    for (int row = 0; row < picture.height; ++row) {
        glm::dvec3 sum(0);
        for (const glm::vec3& texel :
             std::span(picture.texels).subspan(static_cast<std::size_t>(row) * width, width)) {
            sum += glm::dvec3(texel);
        }
        mean += sum * (share_of_row(row, picture.height) / picture.width);
    }
    return mean;
}

template <class T> std::uint64_t hashed(std::uint64_t before, const T& value) {
    return fingerprint(std::as_bytes(std::span(&value, 1)), before);
}

void check_texel(const glm::vec3& texel, std::size_t index, int width, const std::string& name) {
    const auto row = index / static_cast<std::size_t>(width);
    const auto column = index % static_cast<std::size_t>(width);
    const char* fault = nullptr;
    for (int c = 0; c < 3; ++c) {
        fault = !std::isfinite(texel[c])     ? "is not a finite number"
                : texel[c] < 0               ? "is negative"
                : texel[c] > brightest_texel ? "is brighter than 1e30"
                                             : fault;
    }
    if (fault != nullptr) {
        fail("using '{}' as a sky: the texel in column {} of row {}, ({}, {}, {}), {}; repair the "
             "picture",
             name, column, row, texel.r, texel.g, texel.b, fault);
    }
}

std::shared_ptr<const SkyPicture> finished(SkyPicture&& picture) {
    picture.mean = mean_of(picture);
    picture.fingerprint = fingerprint(std::as_bytes(std::span(picture.texels)),
                                      hashed(empty_fingerprint, picture.width));
    return std::make_shared<const SkyPicture>(std::move(picture));
}

/// The parts of source intervals of unit width that an interval covers.
template <class Add> void for_each_part(double from, double to, int count, const Add& add) {
    const int last = std::min(static_cast<int>(std::ceil(to)), count);
    for (int i = static_cast<int>(from); i < last; ++i) {
        add(i, std::max(from, double(i)), std::min(to, i + 1.0));
    }
}

} // namespace

std::shared_ptr<const SkyPicture>
make_sky_picture(int width, int height, std::vector<glm::vec3> texels, const std::string& name) {
    if (width < 1 || height < 1 ||
        texels.size() != static_cast<std::size_t>(width) * static_cast<std::size_t>(height)) {
        fail("using '{}' as a sky: it has {} texels for {} × {}", name, texels.size(), width,
             height);
    }
    for (std::size_t i = 0; i < texels.size(); ++i) {
        check_texel(texels[i], i, width, name);
    }
    return finished({.width = width,
                     .height = height,
                     .texels = std::move(texels),
                     .mean = {},
                     .fingerprint = 0});
}

std::shared_ptr<const SkyPicture> reduced(const SkyPicture& picture, int width, int height) {
    SkyPicture result{.width = width, .height = height, .texels = {}, .mean = {}, .fingerprint = 0};
    result.texels.reserve(static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
    const double rows = double(picture.height) / height, columns = double(picture.width) / width;
    std::vector<glm::dvec3> line(static_cast<std::size_t>(picture.width));
    for (int y = 0; y < height; ++y) {
        std::fill(line.begin(), line.end(), glm::dvec3(0));
        double all = 0;
        for_each_part(y * rows, (y + 1) * rows, picture.height, [&](int i, double from, double to) {
            const double weight =
                share_above(to, picture.height) - share_above(from, picture.height);
            all += weight;
            const glm::vec3* texel = &picture.texels[static_cast<std::size_t>(i) * line.size()];
            for (glm::dvec3& sum : line) {
                sum += weight * glm::dvec3(*texel++);
            }
        });
        for (int x = 0; x < width; ++x) {
            glm::dvec3 sum(0);
            for_each_part(x * columns, (x + 1) * columns, picture.width,
                          [&](int i, double from, double to) {
                              sum += (to - from) * line[static_cast<std::size_t>(i)];
                          });
            result.texels.emplace_back(sum / (all * columns));
        }
    }
    return finished(std::move(result));
}

double solid_angle(const Sun& sun) {
    const double sine = std::sin(0.5 * double(sun.radius));
    return 4 * pi * sine * sine;
}

glm::dvec3 mean_radiance(const Environment& environment) {
    glm::dvec3 mean = environment.picture ? environment.picture->mean : glm::dvec3(0);
    if (environment.sun) {
        mean += glm::dvec3(environment.sun->radiance) * (solid_angle(*environment.sun) / (4 * pi));
    }
    return mean * double(environment.strength);
}

glm::dvec3 illuminance_of_sun(const Environment& environment) {
    if (!environment.sun) {
        return glm::dvec3(0);
    }
    // The disc's projected solid angle.
    const double sine = std::sin(double(environment.sun->radius));
    return glm::dvec3(environment.sun->radiance) * (pi * sine * sine * environment.strength);
}

glm::dvec3 rotated(const Environment& environment, const glm::dvec3& direction) {
    const double angle = environment.rotation * pi / 180;
    const double c = std::cos(angle), s = std::sin(angle);
    return {direction.x * c + direction.z * s, direction.y, direction.z * c - direction.x * s};
}

std::uint64_t fingerprint(const Environment& environment) {
    std::uint64_t hash = empty_fingerprint;
    if (environment.picture) {
        hash = hashed(hash, environment.picture->fingerprint);
    }
    hash = hashed(hashed(hash, environment.rotation), environment.strength);
    if (environment.sun) {
        hash = hashed(hashed(hashed(hash, environment.sun->towards), environment.sun->radius),
                      environment.sun->radiance);
    }
    return hash;
}

} // namespace argand
