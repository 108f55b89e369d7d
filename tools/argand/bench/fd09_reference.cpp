#include "fd09_reference.hpp"

#include "image/files.hpp"
#include "image/metrics.hpp"
#include "session/render.hpp"

namespace argand {

RenderResult render_all(Device& device, const Scene& scene, const RenderSettings& settings) {
    return render(device, scene, settings, [](double) { return true; });
}

References trace_references(Device& device, const Scene& scene, RenderSettings settings,
                            std::uint32_t samples) {
    settings.method = "path";
    settings.samples = samples;
    settings.budget.reset();
    settings.seed = 1001;
    RenderResult a = render_all(device, scene, settings);
    settings.seed = 1002;
    return {std::move(a), render_all(device, scene, settings)};
}

double rel_mse(const RenderResult& result, const References& references, const std::string& layer) {
    return rel_mse(*find_layer(result.layers, layer), *find_layer(references.a.layers, layer),
                   *find_layer(references.b.layers, layer));
}

} // namespace argand
