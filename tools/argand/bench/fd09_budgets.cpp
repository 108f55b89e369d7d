#include "base/clock.hpp"
#include "base/median.hpp"
#include "bench.hpp"
#include "fd09.hpp"
#include "fd09_reference.hpp"

#include <fmt/format.h>

namespace argand {

void measure_budgets(Device& device, const Scene& scene, RenderSettings settings,
                     const std::vector<double>& budgets, std::uint32_t reference_samples,
                     PaperTable& table) {
    constexpr int runs = 3;
    const References references = trace_references(device, scene, settings, reference_samples);
    for (const double budget : budgets) {
        for (const std::string& method : method_names()) {
            settings.method = method;
            settings.budget.reset();
            render_all(device, scene, settings); // so that no timed run compiles kernels
            settings.budget = budget;
            std::vector<double> seconds;
            double error = 0;
            double indirect = 0;
            RenderStatistics last;
            for (int run = 0; run < runs; ++run) {
                settings.seed = static_cast<std::uint32_t>(run);
                const Clock::time_point start = Clock::now();
                const RenderResult result = render_all(device, scene, settings);
                seconds.push_back(seconds_since(start));
                error += rel_mse(result, references, "") / runs;
                indirect += rel_mse(result, references, "indirect") / runs;
                last = result.statistics;
            }
            table.rows.push_back({{"scene", scene.name},
                                  {"budget [s]", budget},
                                  {"method", method},
                                  {"seconds", median(seconds)},
                                  {"relMSE", error},
                                  {"relMSE, indirect", indirect},
                                  {"samples", last.samples},
                                  {"photons", last.photons_emitted}});
        }
    }
}

} // namespace argand
