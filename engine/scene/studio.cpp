#include "scene/studio.hpp"

#include <cmath>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

namespace argand {

namespace {

const char* const studio_note = "there is no light: a neutral studio is added, brighter from above "
                                "than from below; --env or --sun replaces it";

/// Radiance of the studio at this sine of the height above the horizon.
float studio_radiance(double up) {
    constexpr double above = 1, horizon = 0.5, below = 0.1;
    return static_cast<float>(up > 0 ? horizon + (above - horizon) * up
                                     : horizon + (horizon - below) * up);
}

void remove_note(Scene& scene) { std::erase(scene.notes, studio_note); }

} // namespace

Environment studio() {
    constexpr int rows = 64;
    std::vector<glm::vec3> texels;
    texels.reserve(rows);
    for (int row = 0; row < rows; ++row) {
        texels.emplace_back(studio_radiance(std::cos(std::numbers::pi * (row + 0.5) / rows)));
    }
    Environment environment;
    environment.name = "studio";
    environment.picture = make_sky_picture(1, rows, std::move(texels), environment.name);
    return environment;
}

void add_studio(Scene& scene) {
    scene.environment = studio();
    scene.notes.emplace_back(studio_note);
}

void replace_sky(Scene& scene, const glm::vec3& radiance) {
    remove_note(scene);
    scene.sky = radiance;
    scene.environment.reset();
}

void replace_sky(Scene& scene, Environment environment) {
    remove_note(scene);
    scene.sky.reset();
    scene.environment = std::move(environment);
}

} // namespace argand
