#include "autotune/prospect.hpp"

#include <algorithm>
#include <cmath>

namespace argand {

Prospect prospect_of(const Pilot& pilot, const ErrorModel& model, const Aim& aim, double spent,
                     bool goes_on) {
    Prospect p{.settings = pilot.settings,
               .model = model,
               .seconds_per_pass = pilot.seconds_per_pass,
               .goes_on = goes_on};
    const double done = goes_on ? static_cast<double>(pilot.passes) : 0;
    p.model.wide = std::min(done, static_cast<double>(wide_passes));
    const double each = std::max(pilot.seconds_per_pass, 1e-6);
    // Noise is measured from two passes at least.
    const double wanted =
        aim.error ? std::max(std::ceil(passes_for(p.model, *aim.error)), 2.0) : 1e9;
    const double possible =
        aim.seconds ? std::max(done + std::floor((*aim.seconds - spent) / each), 1.0) : 1e9;
    p.passes = std::max(std::min(wanted, possible), done);
    p.seconds = (p.passes - done) * each;
    p.error = error_after(p.model, p.passes);
    return p;
}

bool reaches(const Prospect& prospect, const Aim& aim) {
    // passes_for() is exact to a thousandth.
    return aim.error && prospect.error <= 1.01 * *aim.error;
}

bool is_better(const Prospect& a, const Prospect& b, const Aim& aim) {
    if (reaches(a, aim) != reaches(b, aim)) {
        return reaches(a, aim);
    }
    return reaches(a, aim) ? a.seconds < b.seconds : a.error < b.error;
}

} // namespace argand
