#include "fd09.hpp"
#include "fd09_map.hpp"
#include "shared/footprint.h"
#include "shared/photon.h"

#include <algorithm>
#include <array>
#include <fmt/format.h>

namespace argand {

namespace {

constexpr std::size_t bins = 21;      // 20 of width 0.05 and one for everything larger
constexpr double paper_largest = 0.7; // the paper's r_max, in its units
constexpr float unclamped = 1e6f;

} // namespace

void measure_radii(Device& device, const Scene& scene, const RenderSettings& render,
                   PaperTable& radii) {
    PaperMap paper = trace_paper_map(device, scene, render);
    // Undo the clamping, to see the sizes that the differentials give.
    FootprintScale& scale = *paper.settings.footprints;
    const double largest = scale.radius_max;
    scale.radius_max = scale.caustic_max = unclamped * paper.scene.record.radius;
    scale.caustic_min = scale.radius_min;
    const PhotonMap map = build(device, paper, 0);
    const std::uint32_t count = download_word(device, map.counters, counter_stored);
    const auto photons = download<PhotonRecord>(device, map.photons, count);
    const auto footprints = download<glm::uvec4>(device, map.footprints, count);
    std::array<std::uint64_t, bins> histogram{};
    std::vector<double> sizes;
    for (std::size_t i = 0; i < count; ++i) {
        if ((photons[i].normal & area_sample_bit) != 0) {
            continue;
        }
        const Footprint f = footprint_of_duals(
            unpack_duals(footprints[i]), unpack_photon_normal(photons[i].normal), map.flatness);
        const double radius = parallelogram_side(f.u, f.v);
        sizes.push_back(radius);
        const double in_paper = radius / largest * paper_largest;
        ++histogram[static_cast<std::size_t>(std::min(in_paper / 0.05, double(bins - 1)))];
    }
    nlohmann::ordered_json row{{"scene", scene.name},
                               {"r_max / scene's radius", largest / paper.scene.record.radius}};
    std::sort(sizes.begin(), sizes.end());
    for (const int percent : {5, 50, 95}) {
        row[fmt::format("{} % below, of r_max", percent)] =
            sizes[(sizes.size() - 1) * static_cast<std::size_t>(percent) / 100] / largest;
    }
    for (std::size_t i = 0; i < bins; ++i) {
        row[i + 1 < bins ? fmt::format("{:.2f} - {:.2f}", 0.05 * double(i), 0.05 * double(i + 1))
                         : "> 1.00"] = histogram[i];
    }
    radii.rows.push_back(row);
}

} // namespace argand
