#include "scene/environment_summary.hpp"

#include "shared/maths.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <numbers>

namespace argand {

namespace {

using json = nlohmann::ordered_json;
using std::numbers::pi;
constexpr double degree = std::numbers::pi / 180;

json vector_json(const glm::dvec3& v) { return json::array({v.x, v.y, v.z}); }

std::string vector_text(const json& v) {
    return fmt::format("{:.4g} {:.4g} {:.4g}", v[0].get<double>(), v[1].get<double>(),
                       v[2].get<double>());
}

json place_json(const glm::dvec3& towards) {
    const SkyPlace place = place_of(towards);
    return {{"elevation", place.elevation}, {"azimuth", place.azimuth}};
}

std::string place_text(const json& object) {
    return fmt::format("elevation {:.1f}, azimuth {:.1f} degrees",
                       object["elevation"].get<double>(), object["azimuth"].get<double>());
}

/// The middle of a texel, in the picture's frame.
glm::dvec3 direction_of_texel(const SkyPicture& picture, std::size_t index) {
    const auto width = static_cast<std::size_t>(picture.width);
    const std::size_t column = index % width, row = index / width;
    const double turn = 2 * pi * ((static_cast<double>(column) + 0.5) / picture.width - 0.5);
    const double angle = pi * (static_cast<double>(row) + 0.5) / picture.height;
    return {std::sin(angle) * std::cos(turn), std::cos(angle), std::sin(angle) * std::sin(turn)};
}

json brightest_json(const Environment& environment) {
    const std::vector<glm::vec3>& texels = environment.picture->texels;
    const auto brightest =
        std::max_element(texels.begin(), texels.end(), [](const glm::vec3& a, const glm::vec3& b) {
            return luminance(a) < luminance(b);
        });
    const auto index = static_cast<std::size_t>(brightest - texels.begin());
    json object = place_json(rotated(environment, direction_of_texel(*environment.picture, index)));
    object["radiance"] = vector_json(glm::dvec3(*brightest) * double(environment.strength));
    return object;
}

json sun_json(const Environment& environment) {
    json object = place_json(rotated(environment, glm::dvec3(environment.sun->towards)));
    object["radius"] = environment.sun->radius / degree;
    object["illuminance"] = vector_json(illuminance_of_sun(environment));
    return object;
}

} // namespace

SkyPlace place_of(const glm::dvec3& towards) {
    const double azimuth = std::atan2(towards.x, -towards.z) / degree;
    return {std::atan2(towards.y, std::hypot(towards.x, towards.z)) / degree,
            azimuth < 0 ? azimuth + 360 : azimuth};
}

glm::dvec3 direction_of(const SkyPlace& place) {
    const double up = place.elevation * degree, turn = place.azimuth * degree;
    return {std::cos(up) * std::sin(turn), std::sin(up), -std::cos(up) * std::cos(turn)};
}

json environment_json(const Scene& scene) {
    if (scene.sky || !scene.environment) {
        return nullptr;
    }
    const Environment& environment = *scene.environment;
    const Bounds box = bounds(scene);
    const double radius = 0.5 * glm::length(glm::dvec3(box.high) - glm::dvec3(box.low));
    const glm::dvec3 mean = mean_radiance(environment);
    json object{{"name", environment.name},
                {"rotation", environment.rotation},
                {"strength", environment.strength},
                {"mean_radiance", vector_json(mean)},
                {"power", vector_json(mean * (4 * pi * pi * radius * radius))}};
    if (environment.picture) {
        object["width"] = environment.picture->width;
        object["height"] = environment.picture->height;
        object["brightest"] = brightest_json(environment);
    }
    object["sun"] = environment.sun ? sun_json(environment) : json(nullptr);
    return object;
}

std::string environment_text(const Scene& scene) {
    const json object = environment_json(scene);
    if (object.is_null()) {
        return "none";
    }
    std::string text = object["name"].get<std::string>();
    if (object.contains("width")) {
        text += fmt::format(", {} × {} texels", object["width"].get<int>(),
                            object["height"].get<int>());
    }
    text += fmt::format(", mean radiance {}, power {}", vector_text(object["mean_radiance"]),
                        vector_text(object["power"]));
    if (object["sun"].is_object()) {
        text += fmt::format("; sun at {}, {} lux", place_text(object["sun"]),
                            vector_text(object["sun"]["illuminance"]));
    } else if (object.contains("width")) {
        text += fmt::format("; brightest at {}: {}", place_text(object["brightest"]),
                            vector_text(object["brightest"]["radiance"]));
    }
    return text;
}

} // namespace argand
