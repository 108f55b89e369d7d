#pragma once

#include "tradeoff/prospect.hpp"

#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace argand {

/// Pilots of one scene, and what follows from all of them.
class Pilots {
public:
    /// with_path: path is one of the ways; without, it only tells the others' bias.
    Pilots(const RenderPasses& render, const Aim& aim, bool with_path)
        : render_(render), aim_(aim), with_path_(with_path) {}

    /// Ends early after so many seconds. Returns false if it was interrupted.
    bool run(const RenderSettings& settings, double seconds = std::numeric_limits<double>::infinity());

    /// More samples of path, which tell the others' bias, for so many seconds. Returns false if it was interrupted.
    bool improve_truth(double seconds);

    /// The estimated light without bias, once path has run.
    const std::optional<Pair>& truth() const { return truth_; }

    bool has(const std::string& method) const { return find(method) != nullptr; }

    /// That all have taken, and one on average.
    double seconds() const { return seconds_; }
    double seconds_each() const { return seconds_ / static_cast<double>(pilots_.size()); }

    /// Best first; one for each pilot, but for path where it is no way.
    const std::vector<Prospect>& prospects() const { return prospects_; }

private:
    const Pilot* find(const std::string& method) const;
    void look_ahead();
    void add_truth(const Pilot& path);

    const RenderPasses& render_;
    const Aim& aim_;
    bool with_path_;
    std::optional<Pair> truth_;
    double truth_samples_ = 0, seconds_ = 0;
    std::vector<Pilot> pilots_;
    std::vector<Prospect> prospects_;
};

} // namespace argand
