#include "report.hpp"

#include <charconv>
#include <cmath>

namespace argand {

using Json = nlohmann::ordered_json;

namespace {

Json flux_json(const FluxSums& flux, const std::array<std::int64_t, 3>& sums) {
    Json channels = Json::array();
    for (const std::int64_t sum : sums) {
        channels.push_back(static_cast<double>(sum) * flux.unit);
    }
    return channels;
}

Json memory_json(const Device& device) {
    Json by_name = Json::object();
    for (const auto& [name, use] : device.memory_by_name()) {
        by_name[name] = use.peak;
    }
    return {{"peak_bytes", device.memory().peak},
            {"reserved_bytes", device.blocks().bytes},
            {"allocations", device.blocks().allocations},
            {"peak_bytes_by_name", by_name}};
}

/// What footprints are made by. Splats have fewer parameters.
Json footprints_json(const FootprintSettings& settings, const FootprintScale& scale) {
    if (scale.splats != 0) {
        return {{"largest_footprint", scale.radius_max},
                {"largest_caustic_footprint", scale.caustic_max},
                {"flatness", scale.flatness}};
    }
    return {{"kernel", settings.uniform_kernel ? "uniform" : "epanechnikov"},
            {"caustic_smoothing", settings.caustic_smoothing},
            {"largest_footprint", scale.radius_max},
            {"largest_caustic_footprint", scale.caustic_max},
            {"flatness", settings.flatness},
            {"fixed_smoothing", settings.fixed_smoothing},
            {"paper_axes", settings.paper_axes},
            {"paper_reemission", settings.paper_reemission}};
}

Json option_json(const Option& option, const RenderSettings& settings) {
    const std::string text = option.get(settings);
    if (option.kind == OptionKind::flag) {
        return text == "on";
    }
    if (option.kind == OptionKind::choice) {
        return text;
    }
    double value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc() || end != text.data() + text.size()) {
        return Json(); // the method chooses
    }
    return option.kind == OptionKind::integer ? Json(static_cast<std::uint64_t>(value))
                                              : Json(value);
}

Json parameters_json(const RenderReport& render) {
    const RenderSettings& settings = render.settings;
    const RenderStatistics& statistics = render.statistics;
    const bool is_limited = settings.bounces != unlimited_bounces;
    Json parameters = {
        {"method", settings.method},
        {"width", settings.width},
        {"height", settings.height},
        {"spp", settings.samples},
        {"photons", settings.photons},
        {"bounces", is_limited ? Json(settings.bounces) : Json()},
        {"radius", statistics.radius},
        {"caustic_radius", statistics.caustic_radius},
        {"k", statistics.neighbours},
        {"caustic_k", statistics.caustic_neighbours},
        {"smoothing", statistics.smoothing},
        {"leaf_size", statistics.leaf_size},
        {"budget", settings.budget ? Json(*settings.budget) : Json()},
        {"query_cell", settings.query_cell},
        {"least_coverage", statistics.least_coverage},
        {"near_field", statistics.near_field},
        {"wide_codes", settings.wide_codes},
        {"follow_roughness", settings.follow_roughness},
        {"cull_back_faces", settings.cull_back_faces},
        {"photon_sampling", settings.photon_sampling == Sampling::sobol ? "sobol" : "random"},
        {"final_gather", settings.final_gather},
        {"everything", settings.everything},
        {"seed", settings.seed},
        {"camera", render.scene.cameras[settings.camera].name},
        {"at", render.scene.seconds ? Json(*render.scene.seconds) : Json()},
        {"exposure", render.display.exposure_ev},
        {"tone", name_of(render.display.tone)},
        {"crop", settings.crop ? Json{settings.crop->x0, settings.crop->y0, settings.crop->x1,
                                      settings.crop->y1}
                               : Json()}};
    if (statistics.footprint_scale) {
        parameters.update(footprints_json(settings.footprints, *statistics.footprint_scale));
    }
    // Options without a key above.
    for (const Option& option : render.method.options) {
        if (!parameters.contains(option.report_key)) {
            parameters[option.report_key] = option_json(option, settings);
        }
    }
    return parameters;
}

} // namespace

Json render_report(const RenderReport& render) {
    const RenderStatistics& statistics = render.statistics;
    const DeviceInfo& info = render.device.info();
    Json stages = Json::array();
    for (const StageTime& stage : render.device.stage_times()) {
        stages.push_back({{"name", stage.name},
                          {"gpu_seconds", info.features.timestamps ? Json(stage.seconds) : Json()},
                          {"runs", stage.runs}});
    }
    Json steps = Json::object();
    if (render.times.load > 0) { // and not only of an earlier frame
        for (const auto& [name, seconds] : render.scene.load_seconds) {
            steps[name] = seconds;
        }
    }
    Json report = {{"scene", render.scene.name},
                   {"outputs", render.outputs},
                   {"parameters", parameters_json(render)},
                   {"device",
                    {{"backend", info.backend},
                     {"name", info.name},
                     {"driver", info.driver},
                     {"api_version", info.api_version},
                     {"kind", to_string(info.kind)},
                     {"subgroup_size", info.subgroup_size}}},
                   {"wall_seconds",
                    {{"load", render.times.load},
                     {"load_steps", steps},
                     {"upload", render.times.upload},
                     {"open_device", render.times.open},
                     {"update", render.times.update},
                     {"render", render.times.render},
                     {"write", render.times.write}}},
                   {"stages", stages},
                   {"samples_per_pixel", statistics.samples},
                   {"passes", statistics.passes},
                   {"photons_emitted", statistics.photons_emitted},
                   {"photons_stored", statistics.photons_stored},
                   {"photons_in_view", std::round(statistics.photons_in_view)},
                   {"mean_footprints", statistics.mean_footprints},
                   {"flux",
                    {{"emitted", flux_json(statistics.flux, statistics.flux.emitted)},
                     {"absorbed", flux_json(statistics.flux, statistics.flux.absorbed)},
                     {"escaped", flux_json(statistics.flux, statistics.flux.escaped)},
                     {"cut", flux_json(statistics.flux, statistics.flux.cut)},
                     {"lost", flux_json(statistics.flux, statistics.flux.lost)}}},
                   {"non_finite_samples", statistics.non_finite},
                   {"interrupted", statistics.interrupted},
                   {"memory", memory_json(render.device)},
                   {"notes", render.scene.notes}};
    for (const auto& [name, count] : statistics.own) {
        report[name] = count;
    }
    return report;
}

Json autotune_report(const AutotunedRender& render, MethodTable methods) {
    const Target& target = render.target;
    Json ways = Json::array();
    for (const Candidate& p : render.candidates) {
        ways.push_back({{"method", p.settings.method},
                        {"spp_a_pass", p.settings.samples},
                        {"photons_a_pass", methods.at(p.settings.method).abilities.photon_map
                                               ? Json(p.settings.photons)
                                               : Json()},
                        {"passes", p.passes},
                        {"seconds", p.seconds},
                        {"relMSE", p.error},
                        {"squared_bias", bias_after(p.model, p.passes).value}});
    }
    return {{"target_error", target.error ? Json(*target.error) : Json()},
            {"budget", target.seconds ? Json(*target.seconds) : Json()},
            {"expected", ways},
            {"pilot_seconds", render.pilot_seconds},
            {"noise", render.measured ? Json(render.measured->noise) : Json()},
            {"squared_bias", render.measured ? Json(render.measured->bias.value) : Json()},
            {"witness", render.witness.empty() ? Json() : Json(render.witness)},
            {"witness_of_caustics",
             render.witness_of_caustics.empty() ? Json() : Json(render.witness_of_caustics)},
            {"witness_seconds", render.witness_seconds},
            {"reached", target.error ? Json(render.reached()) : Json()}};
}

} // namespace argand
