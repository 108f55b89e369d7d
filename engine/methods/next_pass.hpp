#pragma once

#include "methods/budget.hpp"
#include "methods/render.hpp"

namespace argand {

/// The callers that follow a render's progress and decide on its passes.
struct Listeners {
    const OnProgress& progress;
    const OnPass& on_pass; ///< may be empty
};

/// The next pass: as on_pass says; else the next of `passes`, which go on as long as the budget has
/// time. None: no more.
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

/// Reports the share of the work that is done: `done` passes and `part` of the next one. Returns
/// false if the work is to end.
inline bool tell_progress(const Listeners& listeners, const Budget& budget, const PassPlan& plan,
                          std::uint64_t done, double part, std::uint64_t passes) {
    return listeners.progress(listeners.on_pass ? (static_cast<double>(done) + part) / plan.expected
                                                : budget.share(done, part, passes));
}

} // namespace argand
