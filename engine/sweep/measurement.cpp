#include "sweep/measurement.hpp"

#include "base/median.hpp"
#include "image/metrics.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace argand {

using Json = nlohmann::ordered_json;

namespace {

Spread spread_of(const std::vector<double>& values) {
    const auto count = static_cast<double>(values.size());
    Spread spread;
    for (const double value : values) {
        spread.mean += value / count;
    }
    double squares = 0;
    for (const double value : values) {
        squares += (value - spread.mean) * (value - spread.mean);
    }
    spread.deviation = values.size() > 1 ? std::sqrt(squares / (count - 1)) : 0;
    return spread;
}

/// Null stands for infinity, which JSON lacks: the error of a picture whose reference is black.
double number_or_infinity(const Json& json) {
    return json.is_null() ? std::numeric_limits<double>::infinity() : json.get<double>();
}

Json to_json(const Spread& spread) {
    return {{"mean", spread.mean}, {"deviation", spread.deviation}};
}

Spread spread_from(const Json& json) {
    return {number_or_infinity(json.at("mean")), number_or_infinity(json.at("deviation"))};
}

Json or_null(const std::optional<double>& value) { return value ? Json(*value) : Json(); }

std::optional<double> optional_from(const Json& json) {
    return json.is_null() ? std::nullopt : std::optional(json.get<double>());
}

} // namespace

Measurement measure(const Setting& setting, const Trials& trials, const Reference& reference) {
    const Image mean_reference = reference.mean();
    std::vector<double> walls, on_device, errors, similarities;
    std::vector<Image> pictures;
    for (const Trial& trial : trials.trials) {
        walls.push_back(trial.wall_seconds);
        if (trial.device_seconds) {
            on_device.push_back(*trial.device_seconds);
        }
        errors.push_back(rel_mse(trial.picture, reference.a, reference.b));
        similarities.push_back(ssim(trial.picture, mean_reference));
        pictures.push_back(trial.picture);
    }
    Measurement m{.key = setting.key,
                  .method = setting.render.method,
                  .option = setting.option,
                  .value = setting.value,
                  .options = setting.options,
                  .seeds = pictures.size(),
                  .wall_seconds = median(walls),
                  .peak_bytes = trials.peak_bytes,
                  .rel_mse = spread_of(errors),
                  .ssim = spread_of(similarities)};
    if (!on_device.empty()) {
        m.device_seconds = median(on_device);
    }
    if (pictures.size() > 1) {
        m.variance = rel_variance(pictures, reference.a, reference.b);
        m.bias = m.rel_mse.mean - *m.variance;
    }
    return m;
}

Json to_json(const Measurement& m) {
    return {{"key", m.key},
            {"method", m.method},
            {"knob", m.option},
            {"value", m.value},
            {"options", m.options},
            {"picture", m.picture},
            {"seeds", m.seeds},
            {"wall_seconds", m.wall_seconds},
            {"device_seconds", or_null(m.device_seconds)},
            {"peak_bytes", m.peak_bytes},
            {"relMSE", to_json(m.rel_mse)},
            {"SSIM", to_json(m.ssim)},
            {"squared_bias", or_null(m.bias)},
            {"variance", or_null(m.variance)}};
}

Measurement measurement_from(const Json& json) {
    return {.key = json.at("key"),
            .method = json.at("method"),
            .option = json.at("knob"),
            .value = json.at("value"),
            .options = json.at("options"),
            .picture = json.at("picture"),
            .seeds = json.at("seeds"),
            .wall_seconds = json.at("wall_seconds"),
            .device_seconds = optional_from(json.at("device_seconds")),
            .peak_bytes = json.at("peak_bytes"),
            .rel_mse = spread_from(json.at("relMSE")),
            .ssim = spread_from(json.at("SSIM")),
            .bias = optional_from(json.at("squared_bias")),
            .variance = optional_from(json.at("variance"))};
}

} // namespace argand
