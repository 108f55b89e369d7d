#include "commands.hpp"

#include "base/json.hpp"
#include "method_options.hpp"
#include "methods/method_info.hpp"
#include "methods/plan_render.hpp"
#include "scene/motion.hpp"
#include "scene/summary.hpp"
#include "scene_options.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <iterator>
#include <memory>
#include <string>
#include <vector>

namespace argand {

namespace {

struct InspectOptions : SceneOptions {
    MethodTable methods;
    std::string method; ///< empty: that of a render without options
    bool json = false;
};

/// The plan of `argand render` with a method, or without options.
nlohmann::ordered_json plan_json(const Scene& scene, const std::string& method,
                                 MethodTable methods) {
    RenderSettings settings;
    settings.method = method.empty() ? method_for(scene, settings, methods).name : method;
    const Plan plan = plan_render(scene, settings, methods);
    nlohmann::ordered_json features = nlohmann::ordered_json::array();
    for (const auto& [feature, by] : plan.required) {
        const FeatureText text = text_of(feature);
        features.push_back(
            {{"feature", text.key}, {"name", text.name}, {"required_by", by}, {"cost", text.cost}});
    }
    std::vector<std::string> left_out;
    for (const Feature feature : all_features()) {
        if (!plan.needs(feature)) {
            left_out.emplace_back(text_of(feature).key);
        }
    }
    nlohmann::ordered_json json{{"method", settings.method},
                                {"follow_roughness", settings.follow_roughness}};
    const MethodInfo& info = methods.at(settings.method);
    if (is_progressive(info, settings)) {
        json["radius_exponent"] = settings.progressive.exponent;
    }
    if (info.option("frontier-memory") != nullptr) {
        json["frontier_memory"] = settings.frontier.memory;
    }
    json["features"] = features;
    json["left_out"] = left_out;
    return json;
}

/// What a photons queue would keep from frame to frame, and what lets it drop or age; empty if
/// nothing moves.
std::string kept_text(const Scene& scene) {
    const Motion& motion = scene.motion;
    std::vector<std::string> words;
    if (!motion.materials.empty()) {
        words.emplace_back("none while materials change");
    }
    if (!motion.meshes.empty()) {
        words.emplace_back(fmt::format("those whose paths cross no box of {} moving {}",
                                       motion.meshes.size(),
                                       motion.meshes.size() == 1 ? "mesh" : "meshes"));
    }
    if (!motion.lights.empty()) {
        words.emplace_back(motion.lights.size() < scene.lights.size()
                               ? "older ones of lights that move count less"
                               : "older ones count less while lights move");
    }
    if (words.empty() && !motion.cameras.empty()) {
        words.emplace_back("all: only the camera moves");
    }
    return fmt::format("{}", fmt::join(words, "; "));
}

std::string plan_text(const nlohmann::ordered_json& plan, bool is_default) {
    std::string text =
        fmt::format("{:<12}{}{}\n{:<12}{}\n", "method", plan["method"].get<std::string>(),
                    is_default ? " (default)" : "", "requires", plan["features"].size());
    for (const nlohmann::ordered_json& feature : plan["features"]) {
        const auto cost = feature["cost"].get<std::string>();
        fmt::format_to(std::back_inserter(text), "  {}: {}{}{}\n",
                       feature["name"].get<std::string>(),
                       feature["required_by"].get<std::string>(), cost.empty() ? "" : "; ", cost);
    }
    if (plan.contains("radius_exponent")) {
        fmt::format_to(std::back_inserter(text),
                       "{:<12}fall from pass to pass, as n^-{:.3g} after n photons\n", "widths",
                       plan["radius_exponent"].get<double>());
    }
    if (plan.contains("frontier_memory")) {
        fmt::format_to(std::back_inserter(text),
                       "{:<12}find photons through a tree; with --query simultaneous all together, "
                       "with up to {} MiB for photons\n",
                       "queries", plan["frontier_memory"].get<std::uint64_t>() >> 20);
    }
    std::vector<std::string> names;
    for (const nlohmann::ordered_json& key : plan["left_out"]) {
        names.push_back(key.get<std::string>());
    }
    return text +
           fmt::format("{:<12}{}\n", "left out",
                       names.empty() ? "nothing" : fmt::format("{}", fmt::join(names, ", ")));
}

void inspect(const InspectOptions& options) {
    if (!options.method.empty()) {
        check_methods({options.method}, options.methods);
    }
    const Scene scene = load_scene(options, options.seconds);
    nlohmann::ordered_json summary = summary_json(scene);
    const nlohmann::ordered_json plan = plan_json(scene, options.method, options.methods);
    const std::string kept = kept_text(scene);
    if (options.json) {
        summary["plan"] = plan;
        if (!kept.empty()) {
            summary["photon_queue_keeps"] = kept;
        }
        fmt::print("{}", json_text(summary));
    } else {
        fmt::print("{}{}", summary_text(scene), plan_text(plan, options.method.empty()));
        if (!kept.empty()) {
            fmt::print("{:<12}by --method photon-queue, of the photons: {}\n", "frames keep", kept);
        }
    }
}

} // namespace

void add_inspect_command(CLI::App& app, MethodTable methods) {
    CLI::App* command = app.add_subcommand(
        "inspect",
        "Describe a scene: its contents, what Argand ignores, and what a render would require");
    auto options = std::make_shared<InspectOptions>(InspectOptions{SceneOptions(), methods, ""});
    add_scene_options(*command, *options);
    command->add_option("--method", options->method,
                        "Say what a render by this method would require (default: the scene's)");
    command->add_flag("--json", options->json, "Print JSON");
    command->footer("Example:\n  argand inspect assets/cornell_glass.glb");
    command->callback([options] { inspect(*options); });
}

} // namespace argand
