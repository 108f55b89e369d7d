#pragma once

#include "autotune/prospect.hpp"

#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace argand {

/// Renders the settings' samples and photons again and again, as argand::render with `on_pass`.
using RenderPasses =
    std::function<RenderResult(const RenderSettings& settings, const OnPass& on_pass)>;

/// Asked when a pilot is complete for what goes on from its passes; nothing: they are thrown away.
using GoOn = std::function<OnPass()>;

/// Pilots of one scene, and what follows from all of them.
class Pilots {
public:
    /// with_path: path is one of the ways; without, it only tells the others' bias.
    Pilots(const RenderPasses& render, const Aim& aim, bool with_path)
        : render_(render), aim_(aim), with_path_(with_path) {}

    /// Runs one more, which ends early after so many seconds, and what goes on from it. While
    /// `go_on` is asked, the prospects are such that the last pilot goes on.
    RenderResult run(const RenderSettings& settings, double seconds, const GoOn& go_on);

    /// More samples of path, which tell the others' bias, for so many seconds. Returns false if it
    /// was interrupted.
    bool improve_truth(double seconds);

    /// The estimated light without bias, once path has run.
    const std::optional<Pair>& truth() const { return truth_; }

    /// How many have run.
    std::size_t count(const std::string& method) const;
    const Pilot& last() const { return pilots_.back(); }
    bool last_is_best() const;

    /// That all have taken, and one on average.
    double seconds() const { return seconds_; }
    double seconds_each() const { return seconds_ / static_cast<double>(pilots_.size()); }

    /// Best first; one for each pilot, but for path where it is no way.
    const std::vector<Prospect>& prospects() const { return prospects_; }

private:
    void add(Pilot pilot);
    void learn();
    void look_ahead(bool last_goes_on);
    void add_truth(const Pilot& path);

    const RenderPasses& render_;
    const Aim& aim_;
    bool with_path_;
    std::optional<Pair> truth_;
    double truth_samples_ = 0, seconds_ = 0;
    std::vector<Pilot> pilots_;
    std::vector<ErrorModel> models_; ///< of each
    std::vector<Prospect> prospects_;
};

} // namespace argand
