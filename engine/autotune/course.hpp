#pragma once

#include "autotune/halves.hpp"
#include "autotune/prospect.hpp"
#include "base/clock.hpp"
#include "methods/budget.hpp"

#include <optional>

namespace argand {

/// Time that is spent on an error if no other is asked for.
inline constexpr double most_seconds = 3600;

/// What is known of a picture's error while it is rendered.
struct Measured {
    double passes = 0;   ///< after which it was
    double noise = 0;    ///< relMSE that is due to it
    Estimate bias{0, 0}; ///< squared
    double error() const { return noise + bias.value; }
};

/// Decides after each pass whether there is another, and measures the error.
class Course {
public:
    /// truth: the estimated light without bias, if it is known. spent: seconds before this.
    Course(const Aim& aim, const Prospect& prospect, const std::optional<Pair>& truth,
           double spent);

    /// Goes on from the passes of a pilot, which are the picture's first. Called before the first
    /// of its own.
    void go_on_from(const Pilot& pilot);

    std::optional<PassPlan> operator()(const PictureSoFar& so_far);

    /// Nothing before both halves have a pass.
    const std::optional<Measured>& measured() const { return measured_; }
    bool reached() const { return reached_; }

private:
    void add(const Image& mean_so_far, const Image& estimated_so_far);
    void measure();
    bool has_time(std::uint64_t done);
    double passes_in_time(std::uint64_t done) const;
    const MethodInfo& method() const;
    bool tells_bias() const;
    bool asks_estimated() const;
    double to_error() const;
    bool takes_too_long(double times) const;

    const Aim& aim_;
    Prospect prospect_;
    const std::optional<Pair>& truth_;
    ErrorModel model_;
    double seconds_; ///< for passes of its own
    Budget budget_;
    Clock::time_point start_;
    std::uint64_t begun_ = 0;   ///< passes of the pilot
    Halves halves_, estimated_; ///< of the whole picture; of its estimated light, where it is asked
    std::optional<Measured> measured_;
    bool reached_ = false;
};

} // namespace argand
