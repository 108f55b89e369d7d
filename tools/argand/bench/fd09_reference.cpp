#include "fd09_reference.hpp"

#include "image/files.hpp"

#include <cmath>

namespace argand {

RenderResult render_all(Device& device, const Scene& scene, const RenderSettings& settings) {
    return render(device, scene, settings, [](double) { return true; });
}

References trace_references(Device& device, const Scene& scene, RenderSettings settings, std::uint32_t samples) {
    settings.method = "path";
    settings.samples = samples;
    settings.budget.reset();
    settings.seed = 1001;
    RenderResult a = render_all(device, scene, settings);
    settings.seed = 1002;
    return {std::move(a), render_all(device, scene, settings)};
}

double rel_mse(const RenderResult& result, const References& references, const std::string& layer) {
    const std::vector<glm::vec3>& x = find_layer(result.layers, layer)->pixels;
    const std::vector<glm::vec3>& a = find_layer(references.a.layers, layer)->pixels;
    const std::vector<glm::vec3>& b = find_layer(references.b.layers, layer)->pixels;
    const auto pixels = static_cast<double>(x.size());
    glm::dvec3 mean(0);
    for (std::size_t i = 0; i < x.size(); ++i) {
        mean += 0.5 * (glm::dvec3(a[i]) + glm::dvec3(b[i])) / pixels;
    }
    const double floor = 0.01 * std::pow((mean.r + mean.g + mean.b) / 3, 2);
    double sum = 0;
    for (std::size_t i = 0; i < x.size(); ++i) {
        for (int c = 0; c < 3; ++c) {
            const double of_a = a[i][c];
            const double of_b = b[i][c];
            sum += (x[i][c] - of_a) * (x[i][c] - of_b) / (0.25 * (of_a + of_b) * (of_a + of_b) + floor);
        }
    }
    return sum / (3 * pixels);
}

} // namespace argand
