#include "commands.hpp"

#include "accel/device_scene.hpp"
#include "base/json.hpp"
#include "methods/render.hpp"
#include "scene/gltf.hpp"
#include "scene/summary.hpp"
#include "shared/follow.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <iterator>
#include <memory>
#include <set>

namespace argand {

namespace {

struct InspectOptions {
    std::string scene;
    bool json = false;
};

std::vector<std::string> lobe_names(std::uint32_t lobes) {
    constexpr std::pair<std::uint32_t, const char*> names[] = {
        {LOBE_DIFFUSE, "diffuse"}, {LOBE_GLOSSY, "glossy"}, {LOBE_MIRROR, "mirror"}, {LOBE_TRANSMIT, "transmission"},
        {LOBE_PASS, "alpha"}};
    std::vector<std::string> found;
    for (const auto& [lobe, name] : names) {
        if ((lobes & lobe) != 0) {
            found.emplace_back(name);
        }
    }
    return found;
}

/// What `argand render` without options would make of the scene. `summary`: the scene's.
nlohmann::ordered_json plan_json(const Scene& scene, const nlohmann::ordered_json& summary) {
    const RenderSettings settings;
    std::uint32_t followed = 0;
    std::uint32_t estimated = 0;
    for (const Material& material : scene.materials) {
        const MaterialRecord record = material_record(material);
        followed |= followed_lobes(record, settings.follow_roughness);
        estimated |= estimated_lobes(record, settings.follow_roughness);
    }
    std::set<std::string> lights;
    for (const auto& light : summary["lights"]) {
        lights.insert(light["kind"].get<std::string>());
    }
    if (summary["emissive"]["triangles"].get<std::size_t>() > 0) {
        lights.insert("emissive triangles");
    }
    if (scene.sky) {
        lights.insert("sky");
    }
    const std::uint32_t lobes = followed | estimated;
    return {{"method", settings.method},
            {"follow_roughness", settings.follow_roughness},
            {"followed", lobe_names(followed)},
            {"estimated", lobe_names(estimated)},
            {"light_kinds", lights},
            {"caustics", followed != 0 && estimated != 0},
            {"specular_differentials", (lobes & (LOBE_MIRROR | LOBE_TRANSMIT)) != 0},
            {"glossy_differentials", (lobes & LOBE_GLOSSY) != 0}};
}

std::string plan_text(const nlohmann::ordered_json& plan) {
    std::string text;
    const auto line = [&](const char* title, const std::string& value) {
        fmt::format_to(std::back_inserter(text), "{:<12}{}\n", title, value);
    };
    const auto list = [&](const char* title, const char* key) {
        const auto names = plan[key].get<std::vector<std::string>>();
        line(title, names.empty() ? "none" : fmt::format("{}", fmt::join(names, ", ")));
    };
    const auto carried = [&](const char* key) { return plan[key].get<bool>() ? "with" : "without"; };
    line("method", fmt::format("{} (default)", plan["method"].get<std::string>()));
    list("followed", "followed");
    list("estimated", "estimated");
    list("light from", "light_kinds");
    line("caustics", plan["caustics"].get<bool>() ? "possible" : "none");
    line("photons", fmt::format("carry differentials {} specular, {} glossy terms", carried("specular_differentials"),
                                carried("glossy_differentials")));
    return text;
}

void inspect(const InspectOptions& options) {
    const Scene scene = load_gltf(options.scene);
    nlohmann::ordered_json summary = summary_json(scene);
    const nlohmann::ordered_json plan = plan_json(scene, summary);
    if (options.json) {
        summary["plan"] = plan;
        fmt::print("{}", json_text(summary));
    } else {
        fmt::print("{}{}", summary_text(scene), plan_text(plan));
    }
}

} // namespace

void add_inspect_command(CLI::App& app) {
    CLI::App* command = app.add_subcommand(
        "inspect", "Say what is in a scene, what of it is not understood, and what would be done with it");
    auto options = std::make_shared<InspectOptions>();
    command->add_option("scene", options->scene, "glTF 2.0 file (.gltf, .glb)")->required();
    command->add_flag("--json", options->json, "Print JSON");
    command->footer("Example:\n  argand inspect assets/cornell_glass.glb");
    command->callback([options] { inspect(*options); });
}

} // namespace argand
