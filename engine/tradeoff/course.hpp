#pragma once

#include "methods/budget.hpp"
#include "tradeoff/halves.hpp"
#include "tradeoff/prospect.hpp"

#include <chrono>
#include <optional>

namespace argand {

/// Time that is spent on an error if no other is asked for.
inline constexpr double most_seconds = 3600;

/// What is known of a picture's error while it is rendered.
struct Measured {
    double passes = 0;          ///< after which it was
    double noise = 0;           ///< relMSE that is due to it
    Estimate bias{0, 0};        ///< squared
    double error() const { return noise + bias.value; }
};

/// Decides after each pass whether there is another, and measures the error.
class Course {
public:
    /// truth: the estimated light without bias, if it is known. spent: seconds before this.
    Course(const Aim& aim, const Prospect& prospect, const std::optional<Pair>& truth, double spent);

    std::optional<PassPlan> operator()(const PictureSoFar& so_far);

    /// Nothing before both halves have a pass.
    const std::optional<Measured>& measured() const { return measured_; }
    bool reached() const { return reached_; }

private:
    void measure(const PictureSoFar& so_far);
    double to_error() const;
    bool takes_too_long(double times) const;

    const Aim& aim_;
    const Prospect& prospect_;
    const std::optional<Pair>& truth_;
    Budget budget_;
    std::chrono::steady_clock::time_point start_;
    Halves halves_, estimated_;     ///< of the whole picture; of its estimated light, if its truth is known
    std::optional<Measured> measured_;
    bool reached_ = false;
};

} // namespace argand
