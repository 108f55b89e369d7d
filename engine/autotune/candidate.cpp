#include "autotune/candidate.hpp"

#include <algorithm>
#include <cmath>

namespace argand {

Candidate candidate_for(const Pilot& pilot, const ErrorModel& model, const Target& target,
                        double spent, bool continues_pilot) {
    Candidate c{.settings = pilot.settings,
                .model = model,
                .seconds_per_pass = pilot.seconds_per_pass,
                .continues_pilot = continues_pilot};
    const double done = continues_pilot ? static_cast<double>(pilot.passes) : 0;
    c.model.initial_passes = std::min(done, static_cast<double>(initial_pilot_passes));
    const double each = std::max(pilot.seconds_per_pass, 1e-6);
    // It takes at least two passes to measure noise.
    const double wanted =
        target.error ? std::max(std::ceil(passes_for(c.model, *target.error)), 2.0) : 1e9;
    const double possible =
        target.seconds ? std::max(done + std::floor((*target.seconds - spent) / each), 1.0) : 1e9;
    c.passes = std::max(std::min(wanted, possible), done);
    c.seconds = (c.passes - done) * each;
    c.error = error_after(c.model, c.passes);
    return c;
}

bool reaches(const Candidate& candidate, const Target& target) {
    // passes_for() is exact to one part in a thousand.
    return target.error && candidate.error <= 1.01 * *target.error;
}

bool is_better(const Candidate& a, const Candidate& b, const Target& target) {
    if (reaches(a, target) != reaches(b, target)) {
        return reaches(a, target);
    }
    return reaches(a, target) ? a.seconds < b.seconds : a.error < b.error;
}

} // namespace argand
