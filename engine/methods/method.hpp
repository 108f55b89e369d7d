#pragma once

#include "base/archive.hpp"
#include "methods/budget.hpp"
#include "methods/eye_paths.hpp"
#include "methods/method_info.hpp"

namespace argand {

/// What the passes of one image share, whichever method makes them.
struct RenderContext {
    Device& device;
    const Scene& scene;
    const RenderSettings& settings;
    DeviceScene on_device;
    EyeWorkspace eye; ///< holds the film
};

/// The random numbers of a pass.
struct PassNumbers {
    std::uint32_t seed = 0;
    std::uint64_t index = 0; ///< of the pass among those of this seed
};

/// One pass.
struct Pass {
    double expected = 1; ///< passes of the whole image, as far as is known
    PassNumbers numbers; ///< the random numbers that it takes
    /// Widths that fall from pass to pass are those of pass `expected`, whichever pass this is.
    bool keeps_width = false;
};

/// Eye paths of a pixel, and photons, that one seed can number. They are the points of a Sobol'
/// sequence of 32 bits.
inline constexpr std::uint64_t numbers_of_seed = 0xffffffffu;

/// A method at work on images of a scene, one after the other. It owns what outlives a pass.
class Method {
public:
    virtual ~Method() = default;

    /// Does the work that precedes the first pass of an image. The context's scene, settings and
    /// lights are those of the image, and its film is empty. Of earlier images only memory is kept,
    /// unless the method has the ability keeps_photons, or an option asks for more. The time of the
    /// first pass begins where this calls budget.start_pass(); work that only the first pass has
    /// goes into budget.once().
    virtual void begin_frame(Budget& budget) { budget.start_pass(); }

    /// Passes over which the samples and photons of the settings are spread. Known after
    /// begin_frame().
    virtual std::uint64_t passes() const { return 1; }

    /// Adds one pass to the film. on_part: told the share of this pass. Returns false if on_part
    /// did; the film then holds the samples that were finished.
    virtual bool pass(const Pass& pass, const OnProgress& on_part) = 0;

    /// Whether the next image of the same scene with the same random numbers would be this one.
    virtual bool is_settled() const { return true; }

    /// Passes, at least one, for which one seed has numbers: their indices are below this. Known
    /// after begin_frame().
    virtual std::uint64_t passes_per_seed() const = 0;

    /// Saves or loads what later passes of the image depend on. Loading replaces begin_frame(), in
    /// a context whose lights are loaded; it throws Error on values that no method saves.
    virtual void persist(Archive& archive) = 0;

    /// A few words on the last pass for those who watch: "radius 0.012". Empty if there is nothing
    /// that changes from pass to pass.
    virtual std::string describe_pass() const { return {}; }

    /// Writes what the method did for the image so far.
    virtual void report(RenderStatistics& statistics) const = 0;
};

} // namespace argand
