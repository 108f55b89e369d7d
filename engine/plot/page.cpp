#include "plot/page.hpp"

#include "base/atomic_write.hpp"
#include "base/base64.hpp"
#include "image/exr.hpp"
#include "image/metrics.hpp"
#include "image/png.hpp"
#include "image/srgb.hpp"
#include "plot/markup.hpp"
#include "plot/plot.hpp"
#include "sweep/tradeoff.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/ranges.h>

namespace argand {

namespace {

constexpr const char* style =
    "body { font: 15px/1.5 sans-serif; max-width: 60rem; margin: 2rem auto; padding: 0 1rem; "
    "color: #222 }\n"
    "table { border-collapse: collapse; font-size: 13px } td, th { padding: 2px 8px; text-align: "
    "right }\n"
    "td:first-child, td:last-child, th:first-child, th:last-child { text-align: left }\n"
    "tr.front { font-weight: bold; background: #f2f2f2 } figure { display: inline-block; margin: "
    "8px }\n"
    "figure img { width: 192px; image-rendering: pixelated } figcaption { font-size: 12px; "
    "max-width: 392px }\n";

// Mean linear luminance at which the reference is displayed.
constexpr double displayed_mean = 0.2;

/// Exposure in stops that brings the image's mean luminance to `displayed_mean`.
float exposure_of(const Image& image) {
    double sum = 0;
    for (const glm::vec3& pixel : image.pixels) {
        sum += luminance(pixel);
    }
    const double mean = sum / static_cast<double>(image.pixels.size());
    return mean > 0 ? static_cast<float>(std::log2(displayed_mean / mean)) : 0;
}

std::string embedded(const Image& image, float exposure, const char* alt) {
    return fmt::format(
        "<img alt=\"{}\" src=\"data:image/png;base64,{}\">", alt,
        base64(png_bytes(image, {.display = {.exposure_ev = exposure}}, "tradeoff.html")));
}

std::string figure(const std::string& pictures, const std::string& caption) {
    return fmt::format("<figure>{}<figcaption>{}</figcaption></figure>\n", pictures, caption);
}

std::string or_dash(const std::optional<double>& value) {
    return value ? fmt::format("{:.3g}", *value) : "–";
}

/// One row of the table of settings.
std::string row(const Measurement& m, bool on_front) {
    constexpr double mebibyte = 1 << 20;
    const std::string cells[] = {
        m.method,
        m.option + " " + m.value,
        fmt::format("{:.3g}", m.wall_seconds),
        or_dash(m.device_seconds),
        fmt::format("{:.1f}", static_cast<double>(m.peak_bytes) / mebibyte),
        fmt::format("{:.3g} ± {:.1g}", m.rel_mse.mean, m.rel_mse.deviation),
        or_dash(m.bias),
        or_dash(m.variance),
        fmt::format("{:.4f}", m.ssim.mean),
        fmt::format("<code>{}</code>", escaped(m.options)),
    };
    return fmt::format("<tr{}><td>{}</td></tr>\n", on_front ? " class=\"front\"" : "",
                       fmt::join(cells, "</td><td>"));
}

std::string table(const std::vector<Measurement>& measurements,
                  const std::vector<std::size_t>& front) {
    std::vector<std::size_t> order(measurements.size());
    for (std::size_t i = 0; i < order.size(); ++i) {
        order[i] = i;
    }
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
        return measurements[a].wall_seconds < measurements[b].wall_seconds;
    });
    std::string html =
        "<table>\n<tr><th>method</th><th>option</th><th>wall, s</th><th>device, s</th><th>peak, "
        "MiB</th>"
        "<th>relMSE</th><th>bias²</th><th>variance</th><th>SSIM</th><th>argand render</th></tr>\n";
    for (const std::size_t i : order) {
        html += row(measurements[i], std::find(front.begin(), front.end(), i) != front.end());
    }
    return html + "</table>\n";
}

std::string front_pictures(const std::filesystem::path& folder, const Results& results,
                           const std::vector<std::size_t>& front, const Reference& reference) {
    const Image truth = reference.mean();
    const float exposure = exposure_of(truth);
    std::string html = figure(embedded(truth, exposure, "reference"), "reference");
    for (const std::size_t i : front) {
        const Measurement& m = results.measurements[i];
        const Image picture = read_exr(folder / m.picture).front().image;
        html += figure(embedded(picture, exposure, "picture") + " " +
                           embedded(difference_picture(picture, truth, m.picture, "the reference"),
                                    0, "error"),
                       fmt::format("{}<br>{:.3g} s, relMSE {:.3g}", escaped(m.options),
                                   m.wall_seconds, m.rel_mse.mean));
    }
    return html;
}

std::string about(const Results& results) {
    std::string text = "<p>";
    for (const auto& [name, value] : results.run.items()) {
        text += fmt::format("{}: {}; ", escaped(name),
                            escaped(value.is_string() ? value.get<std::string>() : value.dump()));
    }
    text += results.reference_samples > 0
                ? fmt::format("reference: two independent pictures by the method {}, {} samples "
                              "a pixel in all",
                              escaped(results.reference_method), results.reference_samples)
                : std::string("reference: given");
    text += results.reference_error
                ? fmt::format(", relMSE of their mean {:.2g}.", *results.reference_error)
                : std::string(", whose own error is unknown and counts as the settings'.");
    if (results.reference_is_blind) {
        text += " <strong>The reference may miss caustics of lights without extent, at least those "
                "that are seen in mirrors or through glass; methods that have them count as wrong "
                "there.</strong>";
    }
    for (const Failure& failure : results.failures) {
        text += fmt::format("<br>Not rendered: <code>{}</code>: {}.", escaped(failure.options),
                            escaped(failure.why));
    }
    return text + (results.complete
                       ? "</p>\n"
                       : " <strong>Some settings are not measured yet.</strong></p>\n");
}

constexpr const char* how_to_read =
    "<p>Each point is one setting of <code>argand render</code>: further left is faster, further "
    "down is more accurate. Points on the Pareto front are outlined: no measured setting is both "
    "faster and more accurate. Point at one to see its setting. The bar at a point is ± the "
    "standard deviation of one seed. Below the orange line errors are smaller than the reference's "
    "own error: points there are about as accurate as the reference, and cannot be ranked; those "
    "at the lower edge may lie anywhere below.</p>\n";

constexpr const char* how_to_read_pictures =
    "<h2>On the front</h2>\n<p>The picture, and its error: red where it is too bright, blue where "
    "it is too dark, black where it is right.</p>\n";

/// The whole page.
std::string page(const std::filesystem::path& folder, const Results& results,
                 const Reference& reference, const Plot& plot) {
    const std::vector<std::size_t> front = front_of(results);
    return fmt::format("<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">"
                       "<title>Error against time</title>\n<style>\n{}</style></head><body>\n"
                       "<h1>Error against time</h1>\n{}",
                       style, how_to_read) +
           to_svg(plot) + about(results) + how_to_read_pictures +
           front_pictures(folder, results, front, reference) + "<h2>All settings</h2>\n" +
           table(results.measurements, front) + "</body></html>\n";
}

} // namespace

void draw_results(const std::filesystem::path& folder, const Results& results, MethodTable table) {
    if (!std::filesystem::exists(reference_file(folder))) {
        return;
    }
    const Reference reference = reread_reference(reference_file(folder));
    const Plot plot = lay_out(results, table);
    write_atomically(folder / "tradeoff.svg", to_svg_file(plot));
    write_atomically(folder / "tradeoff.html", page(folder, results, reference, plot));
}

} // namespace argand
