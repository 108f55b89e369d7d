#pragma once

#include "autotune/error_model.hpp"
#include "image/image.hpp"

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace argand {

/// Estimates the error of a progressive picture for those who watch it, from the picture after each
/// quarter of its first 32, 64, 128, ... passes. The quarters' differences tell the noise and,
/// as each has less bias than the one before, the bias. Passes of one Sobol' sequence make up for
/// each other's errors, so that noise is rather estimated too large.
class RunningError {
public:
    /// law: of the method with its settings. begun: passes that the picture has already. If it is
    /// more than eight, the first measurement is that after four times as many.
    RunningError(const ErrorLaw& law, std::uint64_t begun);

    /// Passes after which the picture is to be added next.
    std::uint64_t next() const { return (means_.size() + 1) * quarter_; }

    /// layers: the picture after next() passes.
    void add(std::span<const Layer> layers);

    /// relMSE after this many passes: the last measurement, by the law. None before the first one.
    std::optional<double> after(std::uint64_t passes) const;

private:
    /// A picture, or a part of its pixels.
    struct Picture {
        Image whole, estimated; ///< all light, and that which photons estimate
    };
    void measure();

    std::uint64_t quarter_;
    std::vector<Picture> means_; ///< after one quarter, two, ...
    ErrorModel model_;
    bool is_measured_ = false;
};

} // namespace argand
