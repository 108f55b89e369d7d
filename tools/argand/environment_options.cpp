#include "environment_options.hpp"

#include "base/error.hpp"
#include "base/text.hpp"
#include "image/files.hpp"
#include "numbers.hpp"
#include "scene/atmosphere.hpp"
#include "scene/gltf.hpp"
#include "scene/studio.hpp"
#include "world/environment_file.hpp"

#include <algorithm>
#include <filesystem>
#include <string_view>
#include <utility>
#include <vector>

namespace argand {

namespace {

/// Numbers with commas between them; nothing if any is none.
std::optional<std::vector<double>> parse_numbers(std::string_view text) {
    std::vector<double> numbers;
    while (true) {
        const std::size_t comma = text.find(',');
        const std::optional<double> number = parse_number<double>(text.substr(0, comma));
        if (!number) {
            return {};
        }
        numbers.push_back(*number);
        if (comma == std::string_view::npos) {
            return numbers;
        }
        text.remove_prefix(comma + 1);
    }
}

bool is_radiance(double x) { return x >= 0 && x <= double(brightest_texel); }

glm::vec3 parse_radiance(const std::string& text) {
    const std::optional<std::vector<double>> numbers = parse_numbers(text);
    if (!numbers || numbers->size() != 3 ||
        !std::all_of(numbers->begin(), numbers->end(), is_radiance)) {
        throw UsageError(fmt::format("reading --env '{}': it is neither a .hdr or .exr file nor a "
                                     "radiance R,G,B of numbers from 0 to 1e30, such as 1,1,1",
                                     one_line(text, 4096)));
    }
    return {(*numbers)[0], (*numbers)[1], (*numbers)[2]};
}

SunPosition parse_sun(const std::string& text) {
    const std::optional<std::vector<double>> numbers = parse_numbers(text);
    const auto is_in = [&](std::size_t i, double low, double high) {
        return (*numbers)[i] >= low && (*numbers)[i] <= high;
    };
    if (!numbers || numbers->size() < 2 || numbers->size() > 3 || !is_in(0, -90, 90) ||
        !is_in(1, -1e6, 1e6) || (numbers->size() == 3 && !is_in(2, 1, 10))) {
        throw UsageError(fmt::format("reading --sun '{}': it is not ELEVATION,AZIMUTH[,TURBIDITY], "
                                     "degrees from -90 to 90, degrees, and 1 to 10, such as "
                                     "30,135,2.5",
                                     one_line(text, 4096)));
    }
    SunPosition sun{.elevation = (*numbers)[0], .azimuth = (*numbers)[1]};
    sun.turbidity = numbers->size() == 3 ? (*numbers)[2] : sun.turbidity;
    return sun;
}

Environment picture_of(const EnvironmentOptions& options) {
    Environment environment;
    environment.name = one_line(std::filesystem::path(options.env).filename().string());
    environment.picture = read_sky_picture(options.env);
    return environment;
}

bool is_picture(const std::string& env) {
    const std::string extension = lower_extension(env);
    return extension == ".hdr" || extension == ".exr";
}

/// The sky that the options describe: at most one of the two.
struct Sky {
    std::optional<glm::vec3> uniform;
    std::optional<Environment> environment;
};

Sky read_sky(const EnvironmentOptions& options) {
    const auto strength = static_cast<float>(options.strength.value_or(1));
    Sky sky;
    if (!options.sun.empty()) {
        sky.environment = sun_and_sky(parse_sun(options.sun));
    } else if (is_picture(options.env)) {
        sky.environment = picture_of(options);
    } else if (!options.env.empty()) {
        sky.uniform = glm::min(parse_radiance(options.env) * strength, glm::vec3(brightest_texel));
    }
    if (sky.environment) {
        sky.environment->rotation += options.rotation.value_or(0);
        sky.environment->strength = strength;
    }
    return sky;
}

/// Complains about options that contradict each other.
void check(const EnvironmentOptions& options) {
    if (!options.env.empty() && !options.sun.empty()) {
        throw UsageError("reading --sun: --env gives the sky already; leave one of them out");
    }
    if (options.env.empty() && options.sun.empty() && (options.rotation || options.strength)) {
        throw UsageError(fmt::format("reading --env-{}: there is no sky that it applies to; give "
                                     "--env or --sun as well",
                                     options.rotation ? "rotation" : "strength"));
    }
}

} // namespace

void add_environment_options(CLI::App& command, EnvironmentOptions& options) {
    command.add_option(
        "--env", options.env,
        "Light from outside: an equirectangular picture, FILE.hdr or FILE.exr, +Y up, "
        "with +X in its middle and +Z a quarter of its width to the right of that; or "
        "the same radiance R,G,B from all directions");
    command.add_option(
        "--sun", options.sun,
        "Light from outside: a clear sky with its sun, ELEVATION,AZIMUTH[,TURBIDITY]: "
        "degrees above the horizon, degrees clockwise from -Z over +X, and haze from "
        "1 (none) to 10 (default: 2.5)");
    command
        .add_option("--env-rotation", options.rotation,
                    "Degrees by which the sky is turned about +Y, counter-clockwise from above "
                    "(default: 0)")
        ->check(number_between(-1e6, 1e6));
    command
        .add_option("--env-strength", options.strength, "Factor of the sky's radiance (default: 1)")
        ->check(number_between(0, 1e6));
}

Scene load_scene(const std::string& file, const EnvironmentOptions& options,
                 std::optional<double> seconds, const LoadOptions& load) {
    check(options);
    Sky sky = read_sky(options);
    Scene scene = load_gltf(file, seconds, load);
    if (sky.uniform) {
        replace_sky(scene, *sky.uniform);
    } else if (sky.environment) {
        replace_sky(scene, std::move(*sky.environment));
    }
    return scene;
}

} // namespace argand
