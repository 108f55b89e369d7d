#pragma once

#include "autotune/candidate.hpp"
#include "autotune/measured_error.hpp"
#include "autotune/witness.hpp"

#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace argand {

/// A picture to hand out if the user interrupts the render.
struct Picture {
    RenderResult result;
    RenderSettings settings;                 ///< of one pass
    std::optional<std::size_t> pilot = {};   ///< its number, if it is that of a complete one
    std::optional<MeasuredError> error = {}; ///< none: it has too few passes

    bool is_interrupted() const { return result.statistics.interrupted; }
};

/// Called when a pilot is complete. Returns the control of further passes that continue from the
/// pilot's, or null to throw its passes away.
using Continuation = std::function<OnPass()>;

/// Runs pilots of one scene and ranks the candidates that follow from them.
class Pilots {
public:
    /// with_unbiased: the unbiased method is a candidate. Otherwise it only measures the bias of
    /// the others.
    Pilots(const RenderPasses& render, const Target& target, bool with_unbiased)
        : render_(render), target_(target), with_unbiased_(with_unbiased) {}

    /// Runs one more pilot, which ends early after `seconds`, and the passes that continue from it.
    /// While `continuation` is called, the candidates assume that the last pilot continues. The
    /// error of a complete pilot's picture is left to error_of().
    Picture run(const RenderSettings& settings, double seconds, const Continuation& continuation);

    /// Spends `seconds` on more samples of the unbiased method, to measure the bias of the other
    /// methods better. Returns nothing if there is no such method, or no time for one sample.
    std::optional<Picture> improve_truth(double seconds);

    /// Pictures without bias, once the unbiased method has run.
    const PooledImages& truth() const { return truth_; }

    /// Number of pilots of this method so far.
    std::size_t count(const std::string& method) const;
    const Pilot& last() const { return pilots_.back(); }
    /// Error of the picture of a complete pilot, as far as it is known by now. Nothing if it has
    /// fewer than two passes, or if its method is no candidate.
    std::optional<MeasuredError> error_of(std::size_t pilot) const;

    /// Time of all pilots.
    double seconds() const { return seconds_; }
    /// Whether the unbiased method is a candidate.
    bool with_unbiased() const { return with_unbiased_; }
    /// Mean time of a pilot.
    double seconds_each() const { return seconds_ / static_cast<double>(pilots_.size()); }

    /// Best first: one for each pilot, except those of the unbiased method where it is no
    /// candidate.
    const std::vector<Candidate>& candidates() const { return candidates_; }

private:
    void add(Pilot pilot);
    ErrorModel fitted_to(const Pilot& pilot, const Image& guess) const;
    bool tells_error(const Pilot& pilot) const;
    std::optional<MeasuredError> error_of_unfinished(const Pilot& pilot) const;
    void fit_models();
    void rank_candidates(bool last_continues);
    void add_truth(const Pilot& unbiased);

    const RenderPasses& render_;
    const Target& target_;
    bool with_unbiased_;
    PooledImages truth_;
    double seconds_ = 0;
    std::vector<Pilot> pilots_;
    Image guess_;                    ///< best_guess() of all pilots
    std::vector<ErrorModel> models_; ///< of each pilot
    std::vector<Candidate> candidates_;
};

} // namespace argand
