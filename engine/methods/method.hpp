#pragma once

#include "methods/budget.hpp"
#include "methods/eye_paths.hpp"
#include "methods/method_info.hpp"
#include "methods/streams.hpp"

#include <functional>

namespace argand {

/// What the passes of one image share, whichever method makes them.
struct RenderContext {
    Device& device;
    const Scene& scene;
    const RenderSettings& settings;
    DeviceScene on_device;
    EyeWorkspace eye; ///< holds the film
};

/// One pass.
struct Pass {
    double expected = 1; ///< passes of the whole image, as far as is known
    PassNumbers numbers; ///< the random numbers that it takes
};

/// Told the share of a pass that is done; returns false to stop after the current batch.
using OnPart = std::function<bool(double)>;

/// A method at work on one image. It owns what outlives a pass.
class Method {
public:
    virtual ~Method() = default;

    /// Does the work that precedes the first pass. The time of the first pass begins where this
    /// calls budget.start_pass(); work that only the first pass has goes into budget.once().
    virtual void begin(Budget& budget) { budget.start_pass(); }

    /// Passes over which the samples and photons of the settings are spread. Known after begin().
    virtual std::uint64_t passes() const { return 1; }

    /// Adds one pass to the film. Returns false if `on_part` did; the film then holds the samples
    /// that were finished.
    virtual bool pass(const Pass& pass, const OnPart& on_part) = 0;

    /// Whether the pass of this index within its stream has random numbers of its own.
    virtual bool has_numbers(std::uint64_t index) const = 0;

    /// Writes what the method did so far.
    virtual void report(RenderStatistics& statistics) const = 0;
};

} // namespace argand
