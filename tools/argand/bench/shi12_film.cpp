#include "base/clock.hpp"
#include "image/files.hpp"
#include "image/metrics.hpp"
#include "scene/pose.hpp"
#include "session/render.hpp"
#include "shi12.hpp"
#include "world/world.hpp"

#include <map>

namespace argand {

namespace {

constexpr std::uint64_t frames = 11;
constexpr std::uint64_t period = 6; ///< frames until the light is back
constexpr double fps = 24;

double seconds_of_frame(std::uint64_t frame) { return double(frame % period) / fps; }

/// The two halves of the light's way are the same places.
std::uint64_t place_of(std::uint64_t frame) {
    const std::uint64_t k = frame % period;
    return std::min(k, period - k);
}

struct Truth {
    Image a, b;
};

/// Pictures of the light's places by path tracing, two of each.
std::map<std::uint64_t, Truth> truths_of(Device& device, Scene& scene, RenderSettings settings,
                                         std::uint32_t samples) {
    settings.method = "path";
    settings.own.clear();
    settings.samples = samples;
    std::map<std::uint64_t, Truth> truths;
    for (std::uint64_t place = 0; place <= period / 2; ++place) {
        move_to(seconds_of_frame(place), scene);
        World world(device, scene);
        const auto picture = [&](std::uint32_t seed) {
            settings.seed = seed;
            return whole_picture(
                render(world, scene, settings, [](double) { return true; }).layers);
        };
        truths[place] = {picture(101), picture(102)};
    }
    return truths;
}

} // namespace

nlohmann::ordered_json measure_shi_film(const OpenDevice& open, Scene scene, const Shi12Load& load,
                                        int size, std::uint32_t reference_samples) {
    RenderSettings settings;
    settings.width = settings.height = size;
    settings.samples = 1;
    settings.bounces = 3;
    settings.photons = load.photons;
    const std::unique_ptr<Device> device = open();
    const std::map<std::uint64_t, Truth> truths =
        truths_of(*device, scene, settings, reference_samples);
    struct Way {
        const char* name;
        RenderSettings settings;
    };
    std::vector<Way> ways(3, {"photons", settings});
    ways[0].settings.method = "photons";
    ways[1].name = "queue";
    ways[2].name = "as in the thesis";
    for (std::size_t i = 1; i < ways.size(); ++i) {
        ways[i].settings.method = "photon-queue";
        ways[i].settings.own["window"] = std::to_string(load.window);
    }
    ways[2].settings.own["direct"] = "photons";
    ways[2].settings.own["queue-fill"] = "gradual";
    ways[2].settings.own["half-life"] = "1e9"; // old photons count as new ones
    nlohmann::ordered_json rows = nlohmann::ordered_json::array();
    for (std::uint64_t frame = 0; frame < frames; ++frame) {
        rows.push_back({{"frame", frame}});
    }
    for (const Way& way : ways) {
        move_to(0, scene);
        World world(*device, scene);
        Session session(world, scene, way.settings);
        session.begin_frame(0); // compiles the kernels
        finish(session, [](double) { return true; });
        Session film(world, scene, way.settings);
        for (std::uint64_t frame = 0; frame < frames; ++frame) {
            move_to(seconds_of_frame(frame), scene);
            world.update(scene);
            const Clock::time_point begin = Clock::now();
            film.begin_frame(0);
            const RenderResult result = finish(film, [](double) { return true; });
            const Truth& truth = truths.at(place_of(frame));
            const std::string name = way.name;
            rows[frame][name + " [s]"] = seconds_since(begin);
            rows[frame][name + ": relMSE"] =
                rel_mse(whole_picture(result.layers), truth.a, truth.b);
        }
    }
    return rows;
}

} // namespace argand
