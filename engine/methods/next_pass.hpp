#pragma once

#include "methods/budget.hpp"
#include "methods/methods.hpp"

namespace argand {

/// The next pass: as on_pass says, or one of `passes`, or while the budget has time; none: no more.
inline std::optional<PassPlan> next_pass(const Listeners& listeners, Budget& budget,
                                         const PictureSoFar& so_far, std::uint64_t passes) {
    if (listeners.on_pass) {
        return listeners.on_pass(so_far);
    }
    if (so_far.passes > 0 && !budget.another(so_far.passes, passes)) {
        return std::nullopt;
    }
    return PassPlan{.expected = budget.expected(so_far.passes, passes)};
}

/// Tells how much is done, with `part` of the pass after so many of them. Returns false if the work
/// is to end.
inline bool tell_progress(const Listeners& listeners, const Budget& budget, const PassPlan& plan,
                          std::uint64_t done, double part, std::uint64_t passes) {
    return listeners.progress(listeners.on_pass ? (static_cast<double>(done) + part) / plan.expected
                                                : budget.share(done, part, passes));
}

} // namespace argand
